// What: the conservative list of a cell: triangles that reach into it without a fragment there, as a separate linked
// list per cell. Links are node number + 1; 0 ends a list. Included once per structure that has one: the functions are
// overloads by its reference type.
// Reads, writes: through what the including file defines before, all of it undefined again at the end:
//   FringeRef                reference type of the structure
//   FRINGE_HEAD(s, cell)     the first link of a cell
//   FRINGE_NODES(s)          words of the nodes: triangle, next link, depths in the cell
//   FRINGE_HEADER(s)         has fringe_demand, fringe_capacity and corrupted
// Source: not in the papers; MMRT mentions edge-on triangles as a limitation.
// Depths are not negative. The upper 16 bits of each are stored, the larger one rounded up, so that the stored interval
// contains the given one.

#ifndef ADS_FRINGE_GLSL
#define ADS_FRINGE_GLSL

struct FringeNode {
    uint primitive;
    uint next;
    vec2 depths;          // smallest and largest that the triangle has in the cell
};

uint fringe_pack_depths(vec2 depths) {
    // Rounding up the largest finite number gives infinity; infinity itself stays as it is.
    uint high = min((floatBitsToUint(depths.y) >> 16) + 1u, 0x7F80u);
    return floatBitsToUint(depths.x) >> 16 | high << 16;
}

// Whether the depth interval of a node overlaps [low, high].
bool fringe_meets(FringeNode node, float low, float high) {
    return !(node.depths.x > high) && !(node.depths.y < low);
}
#endif

// Adds a triangle, with its smallest and largest depth in the cell, to the cell's conservative list. Beyond the
// capacity it is only counted.
void fringe_add(FringeRef s, uint cell, uint primitive, vec2 depths) {
    uint node = atomicAdd(FRINGE_HEADER(s).fringe_demand, 1u);
    if (node < FRINGE_HEADER(s).fringe_capacity) {
        FRINGE_NODES(s)[3u * node] = primitive;
        FRINGE_NODES(s)[3u * node + 1u] = atomicExchange(FRINGE_HEAD(s, cell), node + 1u);
        FRINGE_NODES(s)[3u * node + 2u] = fringe_pack_depths(depths);
    }
}

// The node behind a link. A link past the end is counted and answers the end.
FringeNode fringe_node(FringeRef s, uint link) {
    if (link - 1u >= min(FRINGE_HEADER(s).fringe_capacity, FRINGE_HEADER(s).fringe_demand)) {
        atomicAdd(FRINGE_HEADER(s).corrupted, 1u);
        return FringeNode(PRIMITIVE_NONE, 0u, vec2(0.0));
    }
    uint word = 3u * (link - 1u);
    uint depths = FRINGE_NODES(s)[word + 2u];
    return FringeNode(FRINGE_NODES(s)[word], FRINGE_NODES(s)[word + 1u],
        vec2(uintBitsToFloat(depths << 16), uintBitsToFloat(depths & 0xFFFF0000u)));
}

#undef FringeRef
#undef FRINGE_HEAD
#undef FRINGE_NODES
#undef FRINGE_HEADER

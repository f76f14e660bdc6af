// The conservative list of a cell: triangles that reach into it without a fragment there, as a separate linked
// list per cell. Links are node number + 1; 0 ends a list. Included once per structure that has one: the functions are
// overloads by its reference type.
// Reads, writes: through what the including file defines before, all of it undefined again at the end:
//   ConservativeRef                reference type of the structure
//   CONSERVATIVE_HEAD(s, cell)     the first link of a cell
//   CONSERVATIVE_NODES(s)          words of the nodes: triangle, next link, depths in the cell
//   CONSERVATIVE_HEADER(s)         has conservative_demand, conservative_capacity and corrupted
// Source: not in the papers; MMRT mentions edge-on triangles as a limitation.
// Depths are not negative. The upper 16 bits of each are stored, the larger one rounded up, so that the stored interval
// contains the given one.

#ifndef ADS_CONSERVATIVE_GLSL
#define ADS_CONSERVATIVE_GLSL

struct ConservativeNode {
    uint word;            // where its triangle is; PRIMITIVE_NONE: there is no such node
    uint next;
    vec2 depths;          // smallest and largest that the triangle has in the cell
};

uint conservative_pack_depths(vec2 depths) {
    // Rounding up the largest finite number gives infinity; infinity stays unchanged.
    uint high = min((floatBitsToUint(depths.y) >> 16) + 1u, 0x7F80u);
    return floatBitsToUint(depths.x) >> 16 | high << 16;
}

// True if the depth interval of a node overlaps [low, high].
bool conservative_intersects(ConservativeNode node, float low, float high) {
    return !(node.depths.x > high) && !(node.depths.y < low);
}
#endif

// Adds a triangle, with its smallest and largest depth in the cell, to the cell's conservative list. Beyond the
// capacity it is only counted.
void conservative_add(ConservativeRef s, uint cell, uint primitive, vec2 depths) {
    uint node = atomicAdd(CONSERVATIVE_HEADER(s).conservative_demand, 1u);
    if (node < CONSERVATIVE_HEADER(s).conservative_capacity) {
        CONSERVATIVE_NODES(s)[3u * node] = primitive;
        CONSERVATIVE_NODES(s)[3u * node + 1u] = atomicExchange(CONSERVATIVE_HEAD(s, cell), node + 1u);
        CONSERVATIVE_NODES(s)[3u * node + 2u] = conservative_pack_depths(depths);
    }
}

// Returns the node of a link. A link past the end is counted and gives the end of the list.
ConservativeNode conservative_node(ConservativeRef s, uint link) {
    if (link - 1u >= min(CONSERVATIVE_HEADER(s).conservative_capacity, CONSERVATIVE_HEADER(s).conservative_demand)) {
        atomicAdd(CONSERVATIVE_HEADER(s).corrupted, 1u);
        return ConservativeNode(PRIMITIVE_NONE, 0u, vec2(0.0));
    }
    uint word = 3u * (link - 1u);
    uint depths = CONSERVATIVE_NODES(s)[word + 2u];
    return ConservativeNode(word, CONSERVATIVE_NODES(s)[word + 1u],
        vec2(uintBitsToFloat(depths << 16), uintBitsToFloat(depths & 0xFFFF0000u)));
}

// Returns the triangle of a node that there is.
uint conservative_primitive(ConservativeRef s, ConservativeNode node) {
    return CONSERVATIVE_NODES(s)[node.word];
}

#undef ConservativeRef
#undef CONSERVATIVE_HEAD
#undef CONSERVATIVE_NODES
#undef CONSERVATIVE_HEADER

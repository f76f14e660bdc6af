// The conservative list of a cell: the triangles that reach into the cell but have no fragment there. It is a
// linked list per cell, apart from the cell's list of fragments.
// Reads, writes: through what the including file defines first. This file undefines all of it at its end:
//   ConservativeRef                reference type of the structure
//   CONSERVATIVE_HEAD(s, cell)     the first link of a cell
//   CONSERVATIVE_NODES(s)          words of the nodes, three each: triangle, next link, depths in the cell
//   CONSERVATIVE_HEADER(s)         has conservative_demand, conservative_capacity and corrupted
// Source: not in the papers; MMRT mentions edge-on triangles as a limitation.
// A shader with several structures includes this file once per structure: the functions are overloads by the
// reference type. A link is the number of a node plus 1; 0 ends a list. Depths are not negative. A node
// stores the upper 16 bits of the smallest and of the largest depth, the latter rounded up, so that the
// stored interval contains the exact one.

#ifndef ADS_CONSERVATIVE_GLSL
#define ADS_CONSERVATIVE_GLSL

// A node of a conservative list as it is read: without its triangle, which conservative_primitive reads.
struct ConservativeNode {
    uint word;            // first word of the node; PRIMITIVE_NONE if there is no such node
    uint next;            // link of the next node; 0 at the end of the list
    vec2 depths;          // smallest and largest depth that the triangle has in the cell, metres
};

uint conservative_pack_depths(vec2 depths) {
    // Rounding up turns the largest finite number into infinity. The minimum keeps infinity as it is.
    uint high = min((floatBitsToUint(depths.y) >> 16) + 1u, 0x7F80u);
    return floatBitsToUint(depths.x) >> 16 | high << 16;
}

// True if the depth interval of a node overlaps [low, high].
bool conservative_intersects(ConservativeNode node, float low, float high) {
    return !(node.depths.x > high) && !(node.depths.y < low);
}
#endif

// Adds a triangle to the conservative list of a cell, with its smallest and largest depth in the cell. Beyond
// the capacity the triangle is only counted.
void conservative_add(ConservativeRef s, uint cell, uint primitive, vec2 depths) {
    uint node = atomicAdd(CONSERVATIVE_HEADER(s).conservative_demand, 1u);
    if (node < CONSERVATIVE_HEADER(s).conservative_capacity) {
        CONSERVATIVE_NODES(s)[3u * node] = primitive;
        CONSERVATIVE_NODES(s)[3u * node + 1u] = atomicExchange(CONSERVATIVE_HEAD(s, cell), node + 1u);
        CONSERVATIVE_NODES(s)[3u * node + 2u] = conservative_pack_depths(depths);
    }
}

// Returns the node of a link. A link past the end of the pool is counted, and gives a node that ends the
// list.
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

// Returns the triangle of a node that exists.
uint conservative_primitive(ConservativeRef s, ConservativeNode node) {
    return CONSERVATIVE_NODES(s)[node.word];
}

#undef ConservativeRef
#undef CONSERVATIVE_HEAD
#undef CONSERVATIVE_NODES
#undef CONSERVATIVE_HEADER

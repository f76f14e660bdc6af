// The conservative list of a cell: the triangles that reach into the cell but have no fragment there. It is a
// linked list per cell, apart from the cell's list of fragments. A long list may be divided by depth into
// slices, so that rays leave out those that they do not meet.
// Reads, writes: through what the including file defines first. This file undefines all of it at its end:
//   ConservativeRef                reference type of the structure
//   CONSERVATIVE_HEAD(s, cell)     the first link of a cell
//   CONSERVATIVE_NODES(s)          words of the nodes, three each: triangle, next link, depths in the cell
//   CONSERVATIVE_HEADER(s)         has conservative_demand, conservative_capacity and corrupted
//   CONSERVATIVE_DIVIDES           only if long lists are divided; the header then has conservative_slices
// Source: not in the papers; MMRT mentions edge-on triangles as a limitation.
// A shader with several structures includes this file once per structure: the functions are overloads by the
// reference type. A link is the number of a node plus 1; 0 ends a list. Depths are not negative. A node
// stores the upper 16 bits of the smallest and of the largest depth, the latter rounded up, so that the
// stored interval contains the exact one. A slice is a node that has CONSERVATIVE_SLICE among its depths, and
// in place of a triangle the link of the first triangle in it; its next link, and that of the last triangle
// in it, is the next slice.

#ifndef ADS_CONSERVATIVE_GLSL
#define ADS_CONSERVATIVE_GLSL

#include "ads/constants.glsl"

// A node of a conservative list as it is read: without its triangle, which conservative_primitive reads.
struct ConservativeNode {
    uint word;            // first word of the node; PRIMITIVE_NONE if no triangle in the depths asked for
    uint next;            // link of the next node; 0 at the end of the list
    vec2 depths;          // smallest and largest depth that the triangle has in the cell, metres
};

// Depths to ask for if all triangles are wanted.
#define CONSERVATIVE_ALL vec2(0.0, uintBitsToFloat(0x7F800000u))

uint conservative_pack_depths(vec2 depths) {
    // Rounding up turns the largest finite number into infinity. The minimum keeps infinity as it is.
    uint high = min((floatBitsToUint(depths.y) >> 16) + 1u, 0x7F80u);
    return floatBitsToUint(depths.x) >> 16 | high << 16;
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

// Returns the node of a link, with a triangle if its depths overlap those asked for, from x to y. A slice has
// no triangle; if it overlaps, the node next to it is its first triangle. A link past the end of the pool is
// counted, and gives a node that ends the list.
ConservativeNode conservative_node(ConservativeRef s, uint link, vec2 asked) {
    if (link - 1u >= min(CONSERVATIVE_HEADER(s).conservative_capacity, CONSERVATIVE_HEADER(s).conservative_demand)) {
        atomicAdd(CONSERVATIVE_HEADER(s).corrupted, 1u);
        return ConservativeNode(PRIMITIVE_NONE, 0u, vec2(0.0));
    }
    uint word = 3u * (link - 1u);
    uint depths = CONSERVATIVE_NODES(s)[word + 2u];
    vec2 ends = vec2(uintBitsToFloat(depths << 16), uintBitsToFloat(depths & 0x7FFF0000u));
    bool meets = !(ends.x > asked.y) && !(ends.y < asked.x);
    bool is_slice = false;
#ifdef CONSERVATIVE_DIVIDES
    is_slice = depths >= CONSERVATIVE_SLICE;
#endif
    uint next = CONSERVATIVE_NODES(s)[is_slice && meets ? word : word + 1u];
    return ConservativeNode(is_slice || !meets ? PRIMITIVE_NONE : word, next, ends);
}

// Returns the triangle of a node that exists.
uint conservative_primitive(ConservativeRef s, ConservativeNode node) {
    return CONSERVATIVE_NODES(s)[node.word];
}

#ifdef CONSERVATIVE_DIVIDES
// Divides the conservative list of a cell into slices if it is long. Triangles are in slices of equal height
// by their smallest depth. Slices beyond the capacity are only counted, and the list stays as it is.
void conservative_divide(ConservativeRef s, uint cell) {
    uint capacity = CONSERVATIVE_HEADER(s).conservative_capacity;
    uint head = CONSERVATIVE_HEAD(s, cell);
    uint length = 0u;
    float lower = uintBitsToFloat(0x7F800000u);
    float upper = 0.0;
    for (uint link = head; link - 1u < capacity && length <= CONSERVATIVE_LONGEST; length++) {
        uint word = 3u * (link - 1u);
        float depth = uintBitsToFloat(CONSERVATIVE_NODES(s)[word + 2u] << 16);
        lower = min(lower, depth);
        upper = max(upper, depth);
        link = CONSERVATIVE_NODES(s)[word + 1u];
    }
    if (length < CONSERVATIVE_LONG || length > CONSERVATIVE_LONGEST) {
        return;
    }
    atomicAdd(CONSERVATIVE_HEADER(s).conservative_slices, CONSERVATIVE_SLICES);
    uint first = atomicAdd(CONSERVATIVE_HEADER(s).conservative_demand, CONSERVATIVE_SLICES);
    if (first > capacity || CONSERVATIVE_SLICES > capacity - first) {
        return;
    }
    // First link and packed depths of each slice. An empty slice leads to the next one, and has depths that
    // overlap no interval.
    uint starts[CONSERVATIVE_SLICES];
    uint lows[CONSERVATIVE_SLICES];
    uint highs[CONSERVATIVE_SLICES];
    for (uint slice = 0u; slice < CONSERVATIVE_SLICES; slice++) {
        starts[slice] = slice + 1u < CONSERVATIVE_SLICES ? first + slice + 2u : 0u;
        lows[slice] = 0x7F80u;
        highs[slice] = 0u;
    }
    float scale = upper > lower ? float(CONSERVATIVE_SLICES) / (upper - lower) : 0.0;
    uint link = head;
    for (uint i = 0u; i < length; i++) {
        uint word = 3u * (link - 1u);
        uint next = CONSERVATIVE_NODES(s)[word + 1u];
        uint depths = CONSERVATIVE_NODES(s)[word + 2u];
        float place = (uintBitsToFloat(depths << 16) - lower) * scale;
        uint slice = uint(clamp(place, 0.0, float(CONSERVATIVE_SLICES - 1u)));
        lows[slice] = min(lows[slice], depths & 0xFFFFu);
        highs[slice] = max(highs[slice], depths >> 16);
        CONSERVATIVE_NODES(s)[word + 1u] = starts[slice];
        starts[slice] = link;
        link = next;
    }
    for (uint slice = 0u; slice < CONSERVATIVE_SLICES; slice++) {
        uint word = 3u * (first + slice);
        CONSERVATIVE_NODES(s)[word] = starts[slice];
        CONSERVATIVE_NODES(s)[word + 1u] = slice + 1u < CONSERVATIVE_SLICES ? first + slice + 2u : 0u;
        CONSERVATIVE_NODES(s)[word + 2u] = CONSERVATIVE_SLICE | lows[slice] | highs[slice] << 16;
    }
    CONSERVATIVE_HEAD(s, cell) = first + 1u;
}
#endif

#undef ConservativeRef
#undef CONSERVATIVE_HEAD
#undef CONSERVATIVE_NODES
#undef CONSERVATIVE_HEADER
#undef CONSERVATIVE_DIVIDES

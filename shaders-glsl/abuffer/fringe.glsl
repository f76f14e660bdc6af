// What: the fringe of a cell: triangles that reach into it and have no fragment there, in a linked list of their own. Links are
// node number + 1; 0 ends a list.
// Reads, writes: bounds (heads), fringe, header.fringe_demand, header.corrupted.
// Source: not in the paper, which names edge-on triangles as its open limit.
#ifndef ABUFFER_FRINGE_GLSL
#define ABUFFER_FRINGE_GLSL

#include "abuffer/accessors.glsl"

// Word of a cell's head, the last of its bounds.
uint abuffer_fringe_word(uint cell) {
    return (cell + 1u) * abuffer_bounds_stride() - 1u;
}

// Puts a triangle into a cell's fringe, or counts that there was no room for it.
void abuffer_add_fringe(AbufferRef s, uint cell, uint primitive) {
    uint node = atomicAdd(ABUFFER_HEADER(s).fringe_demand, 1u);
    if (node < ABUFFER_HEADER(s).fringe_capacity) {
        ABUFFER_FRINGE(s)[2u * node] = primitive;
        ABUFFER_FRINGE(s)[2u * node + 1u] = atomicExchange(ABUFFER_BOUNDS(s)[abuffer_fringe_word(cell)], node + 1u);
    }
}

// The first link of a cell's fringe.
uint abuffer_fringe_head(AbufferRef s, uint cell) {
    return abuffer_has_fringe() && cell < abuffer_cell_count(s) ? ABUFFER_BOUNDS(s)[abuffer_fringe_word(cell)] : 0u;
}

// Primitive and next of the node behind a link. A link past the end is counted and answers the end.
uvec2 abuffer_fringe_node(AbufferRef s, uint link) {
    if (link - 1u >= min(ABUFFER_HEADER(s).fringe_capacity, ABUFFER_HEADER(s).fringe_demand)) {
        atomicAdd(ABUFFER_HEADER(s).corrupted, 1u);
        return uvec2(PRIMITIVE_NONE, 0u);
    }
    return uvec2(ABUFFER_FRINGE(s)[2u * link - 2u], ABUFFER_FRINGE(s)[2u * link - 1u]);
}

#endif

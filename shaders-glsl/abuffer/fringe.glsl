// What: the conservative lists of an A-buffer's cells: where they are.
// Reads, writes: bounds (heads), fringe, header.fringe_demand, header.corrupted.
// Source: not in the paper; see ads/fringe.glsl.
#ifndef ABUFFER_FRINGE_GLSL
#define ABUFFER_FRINGE_GLSL

#include "abuffer/accessors.glsl"

// Word of a cell's head, the last of its bounds.
uint abuffer_fringe_word(uint cell) {
    return (cell + 1u) * ABUFFER_BOUNDS_STRIDE - 1u;
}

// The first link of a cell's conservative list.
uint abuffer_fringe_head(AbufferRef s, uint cell) {
    return ABUFFER_HAS_FRINGE && cell < abuffer_cell_count(s) ? ABUFFER_BOUNDS(s)[abuffer_fringe_word(cell)] : 0u;
}

#define FringeRef AbufferRef
#define FRINGE_HEAD(s, cell) ABUFFER_BOUNDS(s)[abuffer_fringe_word(cell)]
#define FRINGE_NODES(s) ABUFFER_FRINGE(s)
#define FRINGE_HEADER(s) ABUFFER_HEADER(s)
#include "ads/fringe.glsl"

#endif

// Finds the conservative lists of an A-buffer's cells, for the functions of ads/conservative.glsl.
// Reads, writes: bounds (the heads of lists), conservative lists, header.conservative_demand,
// header.corrupted.
// Source: not in the paper; see ads/conservative.glsl.
#ifndef ABUFFER_CONSERVATIVE_GLSL
#define ABUFFER_CONSERVATIVE_GLSL

#include "abuffer/accessors.glsl"

// Returns the word that holds the head of a cell's conservative list: the last word of the cell's bounds.
uint abuffer_conservative_word(uint cell) {
    return (cell + 1u) * ABUFFER_BOUNDS_STRIDE - 1u;
}

// Returns the first link of a cell's conservative list; 0 if the cell has none.
uint abuffer_conservative_head(AbufferRef s, uint cell) {
    return ABUFFER_HAS_CONSERVATIVE && cell < abuffer_cell_count(s) ? ABUFFER_POOL(s, bounds)[abuffer_conservative_word(cell)]
        : 0u;
}

#define ConservativeRef AbufferRef
#define CONSERVATIVE_HEAD(s, cell) ABUFFER_POOL(s, bounds)[abuffer_conservative_word(cell)]
#define CONSERVATIVE_NODES(s) ABUFFER_POOL(s, conservative)
#define CONSERVATIVE_HEADER(s) ABUFFER_HEADER(s)
#define CONSERVATIVE_DIVIDES
#include "ads/conservative.glsl"

#endif

// Finds the conservative lists of the cells of a layered depth cube, for the functions of
// ads/conservative.glsl.
// Reads, writes: heads, conservative lists, header.conservative_demand, header.corrupted.
// Source: not in the paper; see ads/conservative.glsl.
#ifndef LDC_CONSERVATIVE_GLSL
#define LDC_CONSERVATIVE_GLSL

#include "ldc/accessors.glsl"

// Returns the first link of a cell's conservative list; 0 if the cell has none. If rays test triangles there
// are no such lists, because the list of fragments holds all triangles that reach into the cell.
uint ldc_conservative_head(LdcRef s, uint cell) {
    bool kept = LDC_COVERAGE == LDC_COVERAGE_CONSERVATIVE && LDC_ACCEPT != LDC_ACCEPT_TRIANGLE;
    return kept ? LDC_POOL(s, heads)[cell] : 0u;
}

#define ConservativeRef LdcRef
#define CONSERVATIVE_HEAD(s, cell) LDC_POOL(s, heads)[cell]
#define CONSERVATIVE_NODES(s) LDC_POOL(s, conservative)
#define CONSERVATIVE_HEADER(s) LDC_HEADER(s)
#include "ads/conservative.glsl"

#endif

// What: the conservative lists of the cells of a layered depth cube: where they are.
// Reads, writes: heads, fringe, header.fringe_demand, header.corrupted.
// Source: not in the paper; see ads/fringe.glsl.
#ifndef LDC_FRINGE_GLSL
#define LDC_FRINGE_GLSL

#include "ldc/accessors.glsl"

// The first link of a cell's conservative list.
uint ldc_fringe_head(LdcRef s, uint cell) {
    return LDC_COVERAGE == LDC_COVERAGE_CONSERVATIVE ? LDC_HEADS(s)[cell] : 0u;
}

#define FringeRef LdcRef
#define FRINGE_HEAD(s, cell) LDC_HEADS(s)[cell]
#define FRINGE_NODES(s) LDC_FRINGE(s)
#define FRINGE_HEADER(s) LDC_HEADER(s)
#include "ads/fringe.glsl"

#endif

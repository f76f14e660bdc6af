// The structure's side of binning, and a visit to a rectangle of cells.
// Reads, writes: see the structure's binned.glsl.
#ifndef ADS_BIN_CELLS_GLSL
#define ADS_BIN_CELLS_GLSL

#include "ads/bin_visits.glsl"
#include "structure/binned.glsl"

#ifndef BIN_ENQUEUES
#define BIN_ENQUEUES BIN_VISIT_LARGE
#endif

// Visits a rectangle of cells in one loop: invocations that run in lockstep pay for the longest of each loop.
void bin_visit_cells(Bin bin, ivec2 lower, ivec2 upper) {
    ivec2 size = upper - lower + 1;
    for (int place = 0; place < size.x * size.y; place++) {
        bin_visit(bin, lower + ivec2(place % size.x, place / size.x));
    }
}

#endif

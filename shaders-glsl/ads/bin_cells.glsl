// Includes a structure's part of binning (ads/bin_visits.glsl), and visits the cells of a rectangle.
// Reads, writes: see the structure's binned.glsl.
#ifndef ADS_BIN_CELLS_GLSL
#define ADS_BIN_CELLS_GLSL

#include "ads/bin_visits.glsl"
#include "structure/binned.glsl"

#ifndef BIN_ENQUEUES
#define BIN_ENQUEUES BIN_VISIT_LARGE
#endif

// Visits all cells of a rectangle. This is one loop and not two nested ones, because invocations that run in
// lockstep take as many iterations of a loop as the slowest of them.
void bin_visit_cells(Bin bin, ivec2 lower, ivec2 upper) {
    ivec2 size = upper - lower + 1;
    for (int place = 0; place < size.x * size.y; place++) {
        bin_visit(bin, lower + ivec2(place % size.x, place / size.x));
    }
}

#endif

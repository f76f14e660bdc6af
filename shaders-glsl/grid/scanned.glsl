// The numbers that the shared scan passes run over (ads/scan.glsl): the lengths of lists, which become the
// places where lists begin. Their sum is the demand.
// Reads, writes: lists, scratch, header.demand.
#ifndef GRID_SCANNED_GLSL
#define GRID_SCANNED_GLSL

#include "grid/accessors.glsl"

uint scan_count(GridRef s, uint step) {
    return grid_cell_count(s);
}

uint scan_number(GridRef s, uint step, uint i) {
    return GRID_POOL(s, lists)[i];
}

void scan_set_number(GridRef s, uint step, uint i, uint number) {
    GRID_POOL(s, lists)[i] = number;
}

uint scan_sum(GridRef s, uint step, uint block) {
    return GRID_POOL(s, scratch)[block];
}

void scan_set_sum(GridRef s, uint step, uint block, uint sum) {
    GRID_POOL(s, scratch)[block] = sum;
}

void scan_set_total(GridRef s, uint step, uint total) {
    GRID_HEADER(s).demand = total;
}

#endif

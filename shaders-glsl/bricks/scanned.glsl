// The numbers that the shared scan passes run over (ads/scan.glsl): the lengths of lists, which become the
// places where lists begin. Their sum is not stored: entries were counted with the records, so that the
// demand for both is known at once.
// Reads, writes: lists, sums.
#ifndef BRICKS_SCANNED_GLSL
#define BRICKS_SCANNED_GLSL

#include "bricks/accessors.glsl"

uint scan_count(BricksRef s, uint step) {
    return bricks_listed_cells(s);
}

uint scan_number(BricksRef s, uint step, uint i) {
    return BRICKS_POOL(s, lists)[i];
}

void scan_set_number(BricksRef s, uint step, uint i, uint number) {
    BRICKS_POOL(s, lists)[i] = number;
}

uint scan_sum(BricksRef s, uint step, uint block) {
    return BRICKS_POOL(s, sums)[block];
}

void scan_set_sum(BricksRef s, uint step, uint block, uint sum) {
    BRICKS_POOL(s, sums)[block] = sum;
}

void scan_set_total(BricksRef s, uint step, uint total) {
}

#endif

// The numbers that the scan runs over: lengths of lists become places. Entries are counted with their records, so that
// the demand for both is known at once.
// Reads, writes: lists, sums.
#ifndef BRICKS_SCANNED_GLSL
#define BRICKS_SCANNED_GLSL

#include "bricks/accessors.glsl"

uint scan_count(BrickRef s, uint step) {
    return brick_listed_cells(s);
}

uint scan_number(BrickRef s, uint step, uint i) {
    return BRICK_POOL(s, lists)[i];
}

void scan_set_number(BrickRef s, uint step, uint i, uint number) {
    BRICK_POOL(s, lists)[i] = number;
}

uint scan_sum(BrickRef s, uint step, uint block) {
    return BRICK_POOL(s, sums)[block];
}

void scan_set_sum(BrickRef s, uint step, uint block, uint sum) {
    BRICK_POOL(s, sums)[block] = sum;
}

void scan_set_total(BrickRef s, uint step, uint total) {
}

#endif

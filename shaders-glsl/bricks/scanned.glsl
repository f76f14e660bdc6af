// What: the numbers that scans run over. Step 0, lists: lengths become places. Step 1, bricks: cells that list something
// become such cells before the brick. Entries are counted with their records, so that the demand for both is known at
// once.
// Reads, writes: lists or bricks, sums, header.cell_demand.
#ifndef BRICKS_SCANNED_GLSL
#define BRICKS_SCANNED_GLSL

#include "bricks/accessors.glsl"

uint scan_count(BrickRef s, uint step) {
    return step == 1u ? brick_total(s) : brick_listed_cells(s);
}

uint scan_number(BrickRef s, uint step, uint i) {
    return step == 1u ? BRICK_WORDS(s)[brick_at(i)] : BRICK_LISTS(s)[i];
}

void scan_set_number(BrickRef s, uint step, uint i, uint number) {
    if (step == 1u) {
        BRICK_WORDS(s)[brick_at(i)] = number;
    } else {
        BRICK_LISTS(s)[i] = number;
    }
}

uint scan_sum(BrickRef s, uint step, uint block) {
    return BRICK_SUMS(s)[block];
}

void scan_set_sum(BrickRef s, uint step, uint block, uint sum) {
    BRICK_SUMS(s)[block] = sum;
}

void scan_set_total(BrickRef s, uint step, uint total) {
    if (step == 1u) {
        BRICK_HEADER(s).cell_demand = total;
    }
}

#endif

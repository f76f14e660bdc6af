// What: the numbers that scans run over. Step 0, lists: lengths become places, their sum the demand. Step 1,
// bricks: cells that list something become such cells before the brick.
// Reads, writes: lists or bricks, sums, header.demand or header.cell_demand.
#ifndef PRIMITIVE_SCANNED_GLSL
#define PRIMITIVE_SCANNED_GLSL

#include "primitive/brick_accessors.glsl"

#define ScanRef PrimitiveRef

uint scan_count(PrimitiveRef s, uint step) {
    if (PRIMITIVE_STORAGE == PRIMITIVE_STORAGE_BRICKS) {
        return step == 1u ? primitive_brick_count(s) : primitive_listed_cells(s);
    }
    return primitive_list_count(s);
}

uint scan_number(PrimitiveRef s, uint step, uint i) {
    return step == 1u ? PRIMITIVE_BRICKS(s)[brick_at(i)] : PRIMITIVE_LISTS(s)[i];
}

void scan_set_number(PrimitiveRef s, uint step, uint i, uint number) {
    if (step == 1u) {
        PRIMITIVE_BRICKS(s)[brick_at(i)] = number;
    } else {
        PRIMITIVE_LISTS(s)[i] = number;
    }
}

uint scan_sum(PrimitiveRef s, uint step, uint block) {
    return PRIMITIVE_SUMS(s)[block];
}

void scan_set_sum(PrimitiveRef s, uint step, uint block, uint sum) {
    PRIMITIVE_SUMS(s)[block] = sum;
}

void scan_set_total(PrimitiveRef s, uint step, uint total) {
    if (step == 1u) {
        PRIMITIVE_HEADER(s).cell_demand = total;
    } else if (PRIMITIVE_STORAGE != PRIMITIVE_STORAGE_BRICKS) {
        // Entries in bricks are counted with their records, of which all are known at once.
        PRIMITIVE_HEADER(s).demand = total;
    }
}

#endif

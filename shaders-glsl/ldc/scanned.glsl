// The numbers that the scan of lists runs over: lengths become places, their sum the demand.
// Reads, writes: lists, scratch, header.demand.
#ifndef LDC_SCANNED_GLSL
#define LDC_SCANNED_GLSL

#include "ldc/accessors.glsl"

uint scan_count(LdcRef s, uint step) {
    return ldc_cell_count(s);
}

// Returns an aligned length. Places are aligned already, so that aligning them again changes nothing.
uint scan_number(LdcRef s, uint step, uint i) {
    return ldc_aligned(LDC_POOL(s, lists)[i]);
}

void scan_set_number(LdcRef s, uint step, uint i, uint number) {
    LDC_POOL(s, lists)[i] = number;
}

uint scan_sum(LdcRef s, uint step, uint block) {
    return LDC_POOL(s, scratch)[block];
}

void scan_set_sum(LdcRef s, uint step, uint block, uint sum) {
    LDC_POOL(s, scratch)[block] = sum;
}

void scan_set_total(LdcRef s, uint step, uint total) {
    LDC_HEADER(s).demand = total;
}

#endif

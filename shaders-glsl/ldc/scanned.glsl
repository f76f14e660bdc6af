// Defines the numbers over which the scan of lists runs (ads/scan.glsl): lengths become places, and the sum
// of all lengths becomes the demand.
// Reads, writes: lists, scratch, header.demand.
#ifndef LDC_SCANNED_GLSL
#define LDC_SCANNED_GLSL

#include "ldc/accessors.glsl"

uint scan_count(LdcRef s, uint step) {
    return ldc_cell_count(s);
}

// Returns the aligned length of a list. After the scan the word is a place, which is aligned already and
// stays unchanged.
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

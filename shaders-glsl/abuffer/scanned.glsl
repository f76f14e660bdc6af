// Defines the numbers over which the scan of contiguous lists runs (ads/scan.glsl): the lengths of lists
// become places, and the sum of all lengths becomes the demand.
// Reads, writes: lists, scratch, header.demand.
#ifndef ABUFFER_SCANNED_GLSL
#define ABUFFER_SCANNED_GLSL

#include "abuffer/lists.glsl"

uint scan_count(AbufferRef s, uint step) {
    return abuffer_list_count(s);
}

uint scan_number(AbufferRef s, uint step, uint i) {
    return ABUFFER_POOL(s, lists)[i];
}

void scan_set_number(AbufferRef s, uint step, uint i, uint number) {
    ABUFFER_POOL(s, lists)[i] = number;
}

uint scan_sum(AbufferRef s, uint step, uint block) {
    return ABUFFER_POOL(s, scratch)[block];
}

void scan_set_sum(AbufferRef s, uint step, uint block, uint sum) {
    ABUFFER_POOL(s, scratch)[block] = sum;
}

void scan_set_total(AbufferRef s, uint step, uint total) {
    ABUFFER_HEADER(s).demand = total;
}

#endif

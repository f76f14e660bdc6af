// The numbers that the shared scan passes run over (ads/scan.glsl): the lengths of lists, which become the
// places where lists begin. Their sum is the demand.
// Reads, writes: lists, sums, header.demand.
#ifndef PRIMITIVE_SCANNED_GLSL
#define PRIMITIVE_SCANNED_GLSL

#include "primitive/accessors.glsl"

uint scan_count(PrimitiveRef s, uint step) {
    return primitive_list_count(s);
}

uint scan_number(PrimitiveRef s, uint step, uint i) {
    return PRIMITIVE_POOL(s, lists)[i];
}

void scan_set_number(PrimitiveRef s, uint step, uint i, uint number) {
    PRIMITIVE_POOL(s, lists)[i] = number;
}

uint scan_sum(PrimitiveRef s, uint step, uint block) {
    return PRIMITIVE_POOL(s, sums)[block];
}

void scan_set_sum(PrimitiveRef s, uint step, uint block, uint sum) {
    PRIMITIVE_POOL(s, sums)[block] = sum;
}

void scan_set_total(PrimitiveRef s, uint step, uint total) {
    PRIMITIVE_HEADER(s).demand = total;
}

#endif

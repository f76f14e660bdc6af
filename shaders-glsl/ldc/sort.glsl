// What: the elements of a list for the shared sort: by depth, ties by triangle. Entry k of a sorted list is layer k of
// its cell.
// Reads, writes: lists, depths, payload, scratch, header.long_demand, header.unsorted.
// Source: the order that the peeling of Bürger et al. section 1.2 yields.
#ifndef LDC_SORT_GLSL
#define LDC_SORT_GLSL

#include "ldc/accessors.glsl"

#define SortRef LdcRef

// The list that is sorted: the functions of the shared sort know elements by their number.
LdcRef sorted_structure;
uint sorted_from;

// Depths are not negative, so that they order like their bits.
bool sort_before(uint i, uint j) {
    uint left = ldc_bits_at(sorted_structure, sorted_from + i);
    uint right = ldc_bits_at(sorted_structure, sorted_from + j);
    return left < right || (left == right
        && ldc_primitive(sorted_structure, sorted_from + i) < ldc_primitive(sorted_structure, sorted_from + j));
}

void sort_swap(uint i, uint j) {
    uint left = sorted_from + i;
    uint right = sorted_from + j;
    uint bits = ldc_bits_at(sorted_structure, left);
    uint primitive = ldc_primitive(sorted_structure, left);
    ldc_set_bits(sorted_structure, left, ldc_bits_at(sorted_structure, right));
    ldc_set_primitive(sorted_structure, left, ldc_primitive(sorted_structure, right));
    ldc_set_bits(sorted_structure, right, bits);
    ldc_set_primitive(sorted_structure, right, primitive);
}

uint sort_begin(LdcRef s, uint cell) {
    uvec2 list = ldc_list(s, cell, ldc_places(s));
    sorted_structure = s;
    sorted_from = list.x;
    return list.y - list.x;
}

uint sort_long_take(LdcRef s) {
    return atomicAdd(LDC_HEADER(s).long_demand, 1u);
}

uint sort_long_count(LdcRef s) {
    return LDC_HEADER(s).long_capacity;
}

// Word of the scratch pool at which a long list stands: behind the sums of the scan.
uint sort_long_word(LdcRef s, uint place) {
    return ldc_scan_words(s) + 2u * place;
}

uvec2 sort_long(LdcRef s, uint place) {
    uint word = sort_long_word(s, place);
    return uvec2(LDC_SCRATCH(s)[word], LDC_SCRATCH(s)[word + 1u]);
}

void sort_set_long(LdcRef s, uint place, uvec2 long_list) {
    uint word = sort_long_word(s, place);
    LDC_SCRATCH(s)[word] = long_list.x;
    LDC_SCRATCH(s)[word + 1u] = long_list.y;
}

void sort_count_unsorted(LdcRef s) {
    atomicAdd(LDC_HEADER(s).unsorted, 1u);
}

#include "ads/sort_lists.glsl"

#endif

// Defines the lists of a layered depth cube for the shared sort of ads/sort_lists.glsl. Fragments are sorted
// by depth, at equal depth by triangle. Entry k of a sorted list is layer k of its cell.
// Reads, writes: lists, depths, payload, scratch, header.long_demand, header.unsorted.
// Source: the order that the peeling of Bürger et al. section 1.2 yields.
#ifndef LDC_SORTED_GLSL
#define LDC_SORTED_GLSL

#include "ldc/accessors.glsl"
#include "ldc/names.glsl"
#include "ads/build_constants.glsl"

#define SORT_HEADER(s) LDC_HEADER(s)
// The table of long lists lies in the scratch pool, behind the sums of the scan.
#define SORT_WORD(s, place) LDC_POOL(s, scratch)[ldc_scan_words(s) + (place)]
#define SORT_LIMIT SHORT_LIST_LIMIT
#define SORT_LONG_LIMIT LONG_LIST_LIMIT

// Structure and first place of the list that is being sorted. The functions of the shared sort know an
// element only by its number in the list.
LdcRef sorted_structure;
uint sorted_from;

// True if element i comes before element j. Depths are not negative, so they order like their bits.
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

bool sort_is_possible(LdcRef s) { return ldc_fragments_fit(s); }

uint sort_list_count(LdcRef s) { return ldc_cell_count(s); }

#include "ads/sort_lists.glsl"

#endif

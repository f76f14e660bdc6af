// What: sorts each list by depth, ties by triangle: entry k of a list is layer k of its cell.
// Reads: lists, depths, primitives. Writes: depths, primitives, header.unsorted.
// Source: the order that the peeling of Bürger et al. section 1.2 yields.
#version 460
#include "contract/extensions.glsl"
#include "ldc/accessors.glsl"

layout(local_size_x = LDC_GROUP_SIZE) in;

layout(push_constant, scalar) uniform LdcBuildConstants {
    LdcRef ldc_built;
};

uint sorted_from;         // first place of the list that is sorted

// Depths are not negative, so that they order like their bits.
bool sort_before(uint i, uint j) {
    uint left = ldc_bits_at(ldc_built, sorted_from + i);
    uint right = ldc_bits_at(ldc_built, sorted_from + j);
    return left < right
        || (left == right && LDC_PRIMITIVES(ldc_built)[sorted_from + i] < LDC_PRIMITIVES(ldc_built)[sorted_from + j]);
}

void sort_swap(uint i, uint j) {
    uint bits = ldc_bits_at(ldc_built, sorted_from + i);
    uint primitive = LDC_PRIMITIVES(ldc_built)[sorted_from + i];
    ldc_set_bits(ldc_built, sorted_from + i, ldc_bits_at(ldc_built, sorted_from + j));
    LDC_PRIMITIVES(ldc_built)[sorted_from + i] = LDC_PRIMITIVES(ldc_built)[sorted_from + j];
    ldc_set_bits(ldc_built, sorted_from + j, bits);
    LDC_PRIMITIVES(ldc_built)[sorted_from + j] = primitive;
}

#include "ads/heap_sort.glsl"

void main() {
    uint cell = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * LDC_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (cell >= ldc_cell_count(ldc_built) || !ldc_fragments_fit(ldc_built)) {
        return;
    }
    uvec2 list = ldc_list(ldc_built, cell);
    uint length = list.y - list.x;
    if (length < 2u) {
        return;
    }
    if (length > LDC_SORT_LIMIT) {
        atomicAdd(LDC_HEADER(ldc_built).unsorted, 1u);
        return;
    }
    sorted_from = list.x;
    heap_sort(length);
}

// What: sorts a share of each long list, dispatch by dispatch, and counts those that the last one leaves unsorted.
// Reads: lists, nodes, data, scratch. Writes: lists, nodes, scratch, header.unsorted.
// Source: MMRT section 3.3, reorder pass; the paper cuts lists that are longer than a private array.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/sort_contiguous.glsl"
#include "abuffer/sort_linked.glsl"

layout(local_size_x = ABUFFER_GROUP_SIZE) in;

layout(push_constant, scalar) uniform AbufferBuildConstants {
    AbufferRef abuffer_built;
    uint build_round;
};

void main() {
    uint place = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * ABUFFER_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (place >= min(ABUFFER_HEADER(abuffer_built).long_demand, ABUFFER_HEADER(abuffer_built).long_capacity)) {
        return;
    }
    uint word = abuffer_long_word(abuffer_built, place);
    uint list = ABUFFER_SCRATCH(abuffer_built)[word];
    uint progress = ABUFFER_SCRATCH(abuffer_built)[word + 1u];
    if (progress == LONG_LIST_DONE) {
        return;
    }
    uint result = SORT_DONE;
    if (ABUFFER_CONTIGUOUS) {
        result = abuffer_sort_contiguous(abuffer_built, list, NODE_SORT_LONG_LIMIT, LONG_LIST_STEPS, progress);
    } else {
        result = linked_sort(abuffer_built, list, NODE_SORT_LONG_LIMIT, LONG_LIST_STEPS);
    }
    ABUFFER_SCRATCH(abuffer_built)[word + 1u] = result == SORT_DONE ? LONG_LIST_DONE : progress;
    if (result != SORT_DONE && build_round == LONG_LIST_ROUNDS - 1u) {
        atomicAdd(ABUFFER_HEADER(abuffer_built).unsorted, 1u);
    }
}

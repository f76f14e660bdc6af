// What: sorts each list by depth, ties by payload, and renews the backward links. Lists too long for one dispatch are
// enqueued for build_12_reorder_long. Of paged lists each page is sorted.
// Reads: lists, nodes, data. Writes: lists, nodes, scratch, header.long_demand.
// Source: MMRT section 3.3, reorder pass.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/sort_contiguous.glsl"
#include "abuffer/sort_linked.glsl"
#include "abuffer/sort_page.glsl"

layout(local_size_x = ABUFFER_GROUP_SIZE) in;

layout(push_constant, scalar) uniform AbufferBuildConstants {
    AbufferRef abuffer_built;
};

// Names a list for the dispatches that sort long ones.
void name_long(uint list) {
    uint place = atomicAdd(ABUFFER_HEADER(abuffer_built).long_demand, 1u);
    if (place < ABUFFER_HEADER(abuffer_built).long_capacity) {
        uint word = abuffer_long_word(abuffer_built, place);
        ABUFFER_SCRATCH(abuffer_built)[word] = list;
        ABUFFER_SCRATCH(abuffer_built)[word + 1u] = 0u;
    }
}

// Threads side by side have lists side by side.
void sort_linked(uint group, uint count) {
    uint first = group * ABUFFER_GROUP_SIZE * NODE_SORT_LISTS + gl_LocalInvocationID.x;
    uint left_over = linked_sort_several(abuffer_built, first, ABUFFER_GROUP_SIZE, count);
    while (left_over != 0u) {
        name_long(first + uint(findLSB(left_over)) * ABUFFER_GROUP_SIZE);
        left_over &= left_over - 1u;
    }
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint thread = group * ABUFFER_GROUP_SIZE + gl_LocalInvocationID.x;
    if (ABUFFER_HEADER(abuffer_built).demand > ABUFFER_HEADER(abuffer_built).capacity) {
        return;
    }
    if (ABUFFER_PAGED) {
        if (thread < ABUFFER_HEADER(abuffer_built).demand) {
            abuffer_sort_page(abuffer_built, thread);
        }
    } else if (ABUFFER_CONTIGUOUS) {
        uint progress = 0u;
        if (thread < abuffer_list_count(abuffer_built)
            && abuffer_sort_contiguous(abuffer_built, thread, NODE_SORT_LIMIT, NODE_SORT_STEPS, progress) != SORT_DONE) {
            name_long(thread);
        }
    } else {
        sort_linked(group, abuffer_list_count(abuffer_built));
    }
}

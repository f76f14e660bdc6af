// What: sorts each list by depth, ties by payload, and renews the backward links. Lists too long for one dispatch are
// named for build_8_reorder_long. Of paged lists each page is sorted.
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

void main() {
    uint list = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * ABUFFER_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (ABUFFER_HEADER(abuffer_built).demand > ABUFFER_HEADER(abuffer_built).capacity) {
        return;
    }
    if (abuffer_paged()) {
        if (list < ABUFFER_HEADER(abuffer_built).demand) {
            abuffer_sort_page(abuffer_built, list);
        }
        return;
    }
    if (list >= abuffer_list_count(abuffer_built)) {
        return;
    }
    uint result = SORT_DONE;
    if (abuffer_contiguous()) {
        uint progress = 0u;
        result = abuffer_sort_contiguous(abuffer_built, list, ABUFFER_SORT_LIMIT, ABUFFER_SORT_STEPS, progress);
    } else {
        result = abuffer_sort_linked(abuffer_built, list, ABUFFER_SORT_LIMIT, ABUFFER_SORT_STEPS);
    }
    if (result == SORT_DONE) {
        return;
    }
    uint place = atomicAdd(ABUFFER_HEADER(abuffer_built).long_demand, 1u);
    if (place < ABUFFER_HEADER(abuffer_built).long_capacity) {
        uint word = abuffer_long_word(abuffer_built, place);
        ABUFFER_SCRATCH(abuffer_built)[word] = list;
        ABUFFER_SCRATCH(abuffer_built)[word + 1u] = 0u;
    }
}

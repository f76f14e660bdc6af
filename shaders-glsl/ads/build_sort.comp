// Sorts each list in place. Lists that are too long for one dispatch are stored in a table, for
// ads/build_sort_long.comp.
// Reads, writes: see the structure's sorted.glsl.
// One invocation per list, or per NODE_SORT_LISTS linked lists.
// Source: MMRT section 3.3, reorder pass; Hu et al. section 3.1, sort pass.
#version 460
#include "contract/extensions.glsl"
#include "structure/sorted.glsl"

layout(local_size_x = SORT_GROUP_SIZE) in;

void main() {
    if (!sort_is_possible(build.structure)) {
        return;
    }
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
#ifdef SORT_LINKED
    if (SORT_LINKED) {
        uint first = group * SORT_GROUP_SIZE * NODE_SORT_LISTS + gl_LocalInvocationID.x;
        sort_linked_lists(build.structure, first, SORT_GROUP_SIZE);
        return;
    }
#endif
    uint list = group * SORT_GROUP_SIZE + gl_LocalInvocationID.x;
    if (list < sort_list_count(build.structure)) {
        sort_list(build.structure, list);
    }
}

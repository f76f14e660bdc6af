// Does a share of the sorting of each long list. The last of LONG_LIST_ROUNDS dispatches counts the lists
// that are still not sorted.
// Reads, writes: see the structure's sorted.glsl.
// One invocation per list of the table.
// Source: MMRT section 3.3, reorder pass; Hu et al. section 3.1, sort pass. Both papers cut lists that are
// longer than a private array.
#version 460
#include "contract/extensions.glsl"
#include "structure/sorted.glsl"

layout(local_size_x = SORT_GROUP_SIZE) in;

void main() {
    uint place = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * SORT_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (place < min(SORT_HEADER(build.structure).long_demand, SORT_HEADER(build.structure).long_capacity) && sort_is_possible(build.structure)) {
        sort_long_list(build.structure, place, build.step);
    }
}

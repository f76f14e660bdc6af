// Sorts a share of each long list, dispatch by dispatch, and counts those that the last one leaves unsorted.
// Reads, writes: see the structure's sorted.glsl.
// Source: MMRT section 3.3, reorder pass; Hu et al. section 3.1, sort pass. Both cut lists that are longer than a private array.
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

// What: sorts a share of each long list, dispatch by dispatch, and counts those that the last one leaves unsorted.
// Reads: lists, depths, payload, scratch. Writes: depths, payload, scratch, header.unsorted.
// Source: the order that the peeling of Bürger et al. section 1.2 yields.
#version 460
#include "contract/extensions.glsl"
#include "ldc/sort.glsl"

layout(local_size_x = LDC_GROUP_SIZE) in;

layout(push_constant, scalar) uniform LdcBuildConstants {
    LdcRef ldc_built;
    uint build_round;
};

void main() {
    uint place = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * LDC_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (place < LDC_HEADER(ldc_built).long_demand && ldc_fragments_fit(ldc_built)) {
        sort_long_list(ldc_built, place, build_round);
    }
}

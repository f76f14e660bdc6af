// What: sorts each list, and names those that are too long for one dispatch.
// Reads: lists, depths, payload. Writes: depths, payload, scratch, header.long_demand.
// Source: the order that the peeling of Bürger et al. section 1.2 yields.
#version 460
#include "contract/extensions.glsl"
#include "ldc/sort.glsl"

layout(local_size_x = LDC_GROUP_SIZE) in;

layout(push_constant, scalar) uniform LdcBuildConstants {
    LdcRef ldc_built;
};

void main() {
    uint cell = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * LDC_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (cell < ldc_cell_count(ldc_built) && ldc_fragments_fit(ldc_built)) {
        sort_list(ldc_built, cell);
    }
}

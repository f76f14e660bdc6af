// Writes the status of the build: complete, or overflowed, and whether some lists are too long to be sorted.
// Reads: header, geometry. Writes: header.status. One invocation.
#version 460
#include "contract/extensions.glsl"
#include "ads/build_status.glsl"
#include "ldc/accessors.glsl"
#include "ldc/names.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = 1) in;

void main() {
    bool fits = ldc_fragments_fit(build.structure)
        && LDC_HEADER(build.structure).conservative_demand <= LDC_HEADER(build.structure).conservative_capacity
        && LDC_HEADER(build.structure).long_demand <= LDC_HEADER(build.structure).long_capacity
        && LDC_HEADER(build.structure).layer_demand <= LDC_HEADER(build.structure).layer_capacity
        && LDC_HEADER(build.structure).large_demand <= LDC_HEADER(build.structure).large_capacity;
    uint status = build_status(fits);
    LDC_HEADER(build.structure).status = status | (LDC_HEADER(build.structure).unsorted > 0u ? STATUS_UNSORTED : 0u);
}

// What: declares the structure complete, or says what was missing.
// Reads: header. Writes: header.status.
#version 460
#include "contract/extensions.glsl"
#include "ads/build_status.glsl"
#include "ldc/accessors.glsl"

layout(local_size_x = 1) in;

layout(push_constant, scalar) uniform LdcBuildConstants {
    LdcRef ldc_built;
};

void main() {
    bool fits = ldc_fragments_fit(ldc_built)
        && LDC_HEADER(ldc_built).conservative_demand <= LDC_HEADER(ldc_built).conservative_capacity
        && LDC_HEADER(ldc_built).long_demand <= LDC_HEADER(ldc_built).long_capacity
        && LDC_HEADER(ldc_built).layer_demand <= LDC_HEADER(ldc_built).layer_capacity
        && LDC_HEADER(ldc_built).large_demand <= LDC_HEADER(ldc_built).large_capacity;
    uint status = build_status(fits);
    LDC_HEADER(ldc_built).status = status | (LDC_HEADER(ldc_built).unsorted > 0u ? STATUS_UNSORTED : 0u);
}

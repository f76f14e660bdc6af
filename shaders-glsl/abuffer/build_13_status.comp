// What: declares the structure complete, or says what was missing.
// Reads: header, geometry. Writes: header.status.
#version 460
#include "contract/extensions.glsl"
#include "ads/build_status.glsl"
#include "abuffer/accessors.glsl"

layout(local_size_x = 1) in;

layout(push_constant, scalar) uniform AbufferBuildConstants {
    AbufferRef abuffer_built;
};

void main() {
    bool fits = ABUFFER_HEADER(abuffer_built).demand <= ABUFFER_HEADER(abuffer_built).capacity
        && ABUFFER_HEADER(abuffer_built).near_demand <= ABUFFER_HEADER(abuffer_built).near_capacity
        && ABUFFER_HEADER(abuffer_built).long_demand <= ABUFFER_HEADER(abuffer_built).long_capacity
        && ABUFFER_HEADER(abuffer_built).conservative_demand <= ABUFFER_HEADER(abuffer_built).conservative_capacity
        && ABUFFER_HEADER(abuffer_built).large_demand <= ABUFFER_HEADER(abuffer_built).large_capacity
        && geometry_triangle_count() <= ABUFFER_HEADER(abuffer_built).triangles;
    uint status = build_status(fits);
    ABUFFER_HEADER(abuffer_built).status = status | (ABUFFER_HEADER(abuffer_built).unsorted > 0u ? STATUS_UNSORTED : 0u);
}

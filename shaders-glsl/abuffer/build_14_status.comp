// Writes the status of the build: complete, or overflowed, and whether some lists are too long to be sorted.
// Reads: header, geometry. Writes: header.status. One invocation.
#version 460
#include "contract/extensions.glsl"
#include "ads/build_status.glsl"
#include "abuffer/accessors.glsl"
#include "abuffer/names.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = 1) in;

void main() {
    bool fits = ABUFFER_HEADER(build.structure).demand <= ABUFFER_HEADER(build.structure).capacity
        && ABUFFER_HEADER(build.structure).near_demand <= ABUFFER_HEADER(build.structure).near_capacity
        && ABUFFER_HEADER(build.structure).long_demand <= ABUFFER_HEADER(build.structure).long_capacity
        && ABUFFER_HEADER(build.structure).conservative_demand <= ABUFFER_HEADER(build.structure).conservative_capacity
        && ABUFFER_HEADER(build.structure).large_demand <= ABUFFER_HEADER(build.structure).large_capacity
        && geometry_triangle_count() <= ABUFFER_HEADER(build.structure).triangles;
    uint status = build_status(fits);
    ABUFFER_HEADER(build.structure).status = status | (ABUFFER_HEADER(build.structure).unsorted > 0u
        ? STATUS_UNSORTED : 0u);
}

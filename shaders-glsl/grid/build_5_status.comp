// Sets the status of the grid: complete if everything fitted.
// Reads: header, geometry. Writes: header.status.
// One invocation.
#version 460
#include "contract/extensions.glsl"
#include "grid/header.glsl"
#include "ads/build_status.glsl"
#include "grid/names.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = 1) in;

void main() {
    bool fits = GRID_HEADER(build.structure).demand <= GRID_HEADER(build.structure).capacity
        && geometry_triangle_count() <= GRID_HEADER(build.structure).triangle_capacity;
    GRID_HEADER(build.structure).status = build_status(fits);
}

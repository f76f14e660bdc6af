// Sets the status of the structure: complete if everything fitted.
// Reads: header, geometry. Writes: header.status.
// One invocation.
#version 460
#include "contract/extensions.glsl"
#include "bricks/header.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_status.glsl"

layout(local_size_x = 1) in;

void main() {
    bool lists_fit = BRICKS_HEADER(build.structure).demand <= BRICKS_HEADER(build.structure).capacity
        && BRICKS_HEADER(build.structure).near_demand <= BRICKS_HEADER(build.structure).near_capacity
        && BRICKS_HEADER(build.structure).record_demand <= BRICKS_HEADER(build.structure).record_capacity
        && BRICKS_HEADER(build.structure).cell_demand <= BRICKS_HEADER(build.structure).cell_capacity
        && BRICKS_HEADER(build.structure).brick_demand <= BRICKS_HEADER(build.structure).brick_capacity;
    bool fits = lists_fit && geometry_triangle_count() <= BRICKS_HEADER(build.structure).triangle_capacity
        && BRICKS_HEADER(build.structure).large_demand <= BRICKS_LARGE_LIMIT * BRICKS_HEADER(build.structure).triangle_capacity;
    BRICKS_HEADER(build.structure).status = build_status(fits);
}

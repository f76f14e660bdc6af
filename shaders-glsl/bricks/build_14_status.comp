// Declares the structure complete, or says what was missing.
// Reads: header, geometry. Writes: header.status.
#version 460
#include "contract/extensions.glsl"
#include "bricks/header.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_status.glsl"

layout(local_size_x = 1) in;

void main() {
    bool lists_fit = BRICK_HEADER(build.structure).demand <= BRICK_HEADER(build.structure).capacity
        && BRICK_HEADER(build.structure).near_demand <= BRICK_HEADER(build.structure).near_capacity
        && BRICK_HEADER(build.structure).record_demand <= BRICK_HEADER(build.structure).record_capacity
        && BRICK_HEADER(build.structure).cell_demand <= BRICK_HEADER(build.structure).cell_capacity
        && BRICK_HEADER(build.structure).brick_demand <= BRICK_HEADER(build.structure).brick_capacity;
    bool fits = lists_fit && geometry_triangle_count() <= BRICK_HEADER(build.structure).triangle_capacity
        && BRICK_HEADER(build.structure).large_demand <= BRICK_LARGE_LIMIT * BRICK_HEADER(build.structure).triangle_capacity;
    BRICK_HEADER(build.structure).status = build_status(fits);
}

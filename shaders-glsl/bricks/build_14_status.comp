// What: declares the structure complete, or says what was missing.
// Reads: header, geometry. Writes: header.status.
#version 460
#include "contract/extensions.glsl"
#include "bricks/header.glsl"
#include "ads/build_status.glsl"

layout(local_size_x = 1) in;

layout(push_constant, scalar) uniform BrickBuildConstants {
    BrickRef brick_built;
};

void main() {
    bool lists_fit = BRICK_HEADER(brick_built).demand <= BRICK_HEADER(brick_built).capacity
        && BRICK_HEADER(brick_built).near_demand <= BRICK_HEADER(brick_built).near_capacity
        && BRICK_HEADER(brick_built).record_demand <= BRICK_HEADER(brick_built).record_capacity
        && BRICK_HEADER(brick_built).cell_demand <= BRICK_HEADER(brick_built).cell_capacity
        && BRICK_HEADER(brick_built).brick_demand <= BRICK_HEADER(brick_built).brick_capacity;
    bool fits = lists_fit && geometry_triangle_count() <= BRICK_HEADER(brick_built).triangle_capacity
        && BRICK_HEADER(brick_built).large_demand <= BRICK_LARGE_LIMIT * BRICK_HEADER(brick_built).triangle_capacity;
    BRICK_HEADER(brick_built).status = build_status(fits);
}

// What: declares the structure complete, or says that something did not fit.
// Reads: header, geometry. Writes: header.status.
#version 460
#include "contract/extensions.glsl"
#include "grid/header.glsl"
#include "ads/build_status.glsl"

layout(local_size_x = 1) in;

layout(push_constant, scalar) uniform GridBuildConstants {
    GridRef grid_built;
};

void main() {
    bool fits = GRID_HEADER(grid_built).demand <= GRID_HEADER(grid_built).capacity
        && geometry_triangle_count() <= GRID_HEADER(grid_built).triangle_capacity;
    GRID_HEADER(grid_built).status = build_status(fits);
}

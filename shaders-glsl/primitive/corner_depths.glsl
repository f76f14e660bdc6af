// The published depths of a triangle in a cell: those of its plane at the corners of the cell, whatever part
// of the cell the triangle covers.
// Reads, writes: nothing.
// Source: DIRT section 4.1.1. The authors' program intersects the plane with the rays through the corners,
// and ignores rays whose angle to the plane has a sine of less than a thousandth. If rays are ignored, the
// depths miss part of the triangle.
#ifndef PRIMITIVE_CORNER_DEPTHS_GLSL
#define PRIMITIVE_CORNER_DEPTHS_GLSL

#include "ads/coverage.glsl"
#include "primitive/overlap.glsl"

// Square of the smallest cosine of the angle between a corner's ray and the normal.
const float CORNER_STEEPNESS = 1.0e-6;

// Returns the smallest and the largest depth. If no ray intersects the plane within the view, returns those
// of the whole view. The expressions are precise, since the passes that count and those that store must
// agree.
vec2 primitive_corner_depths(PrimitiveGrid grid, vec3 a, vec3 b, vec3 c, ivec2 cell) {
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    precise vec3 normal = ab.yzx * ac.zxy - ab.zxy * ac.yzx;
    precise float facing = normal.x * a.x + normal.y * a.y + normal.z * a.z;
    precise float size = normal.x * normal.x + normal.y * normal.y + normal.z * normal.z;
    float view_near = 0.5 * grid.near_size;
    vec2 depths = vec2(grid.reach, view_near);
    for (int corner = 0; corner < 4; corner++) {
        float x = cell_boundary(cell.x + (corner & 1), grid.tiles);
        float y = cell_boundary(cell.y + (corner >> 1), grid.tiles);
        precise float along = normal.x * x + normal.y * y + normal.z;
        precise float steepness = along * along;
        precise float least = CORNER_STEEPNESS * size * (x * x + y * y + 1.0);
        precise float depth = facing / along;
        if (steepness >= least && depth >= view_near && depth <= grid.reach) {
            depths = vec2(min(depths.x, depth), max(depths.y, depth));
        }
    }
    return depths.x <= depths.y ? depths : vec2(view_near, grid.reach);
}

// True if the triangle reaches into a cell. `depths` gets the depths by which the triangle is listed there.
bool primitive_reaches(PrimitiveGrid grid, vec3 a, vec3 b, vec3 c, ivec2 cell, out vec2 depths) {
    bool reaches = primitive_overlap(grid, a, b, c, cell, depths);
    if (PRIMITIVE_DEPTHS == PRIMITIVE_DEPTHS_CORNERS && reaches) {
        depths = primitive_corner_depths(grid, a, b, c, cell);
    }
    return reaches;
}

#endif

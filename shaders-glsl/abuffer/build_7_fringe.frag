// What: keeps the triangle in cells that it reaches into without covering their centre, where no fragment stands for
// it: seen edge-on, at silhouettes, and where it is smaller than a cell.
// Reads: geometry, header, bounds, lists, nodes, data. Writes: bounds (heads, marks), fringe, header.fringe_demand. Conservative
// coverage only.
// Source: not in the paper, which names edge-on triangles as its open limit.
#version 460
#include "contract/extensions.glsl"
#include "ads/constants.glsl"
#include "ads/overlap.glsl"
#include "abuffer/fringe.glsl"
#include "abuffer/lists.glsl"
#include "abuffer/raster.glsl"

layout(location = 0) flat in uvec2 primitive_and_view;

// Depth of a triangle's plane along a direction of the view with depth 1; infinite where it is seen edge-on.
float plane_depth(vec3 a, vec3 b, vec3 c, vec3 direction) {
    vec3 normal = cross(b - a, c - a);
    float facing = dot(normal, direction);
    return facing == 0.0 ? uintBitsToFloat(0x7F800000u) : dot(normal, a) / facing;
}

// Whether the plane of a fragment of the cell passes within `close` metres of depth z in this direction.
bool is_stood_for(uint view, uint cell, vec3 direction, float z, float close) {
    float extent = abuffer_bounds(abuffer_built, cell).extent;
    uint read = 0u;
    for (uint bucket = 0u; bucket < ABUFFER_BUCKETS; bucket++) {
        AbufferCursor cursor = abuffer_list_begin(abuffer_built, abuffer_list(cell, bucket), false);
        while (cursor.link != 0u) {
            if (read++ >= FRINGE_LIMIT) {
                return false;
            }
            uint link = abuffer_list_next(abuffer_built, cursor);
            if (link == 0u) {
                break;
            }
            if (abs(abuffer_z(abuffer_built, link) - z) > extent + close) {
                continue;
            }
            vec3 a;
            vec3 b;
            vec3 c;
            abuffer_view_vertices(abuffer_built, abuffer_data(abuffer_built, link, 0u), view, a, b, c);
            if (abs(plane_depth(a, b, c, direction) - z) <= close) {
                return true;
            }
        }
    }
    return false;
}

void main() {
    if (ABUFFER_HEADER(abuffer_built).demand > ABUFFER_HEADER(abuffer_built).capacity) {
        // What stands for what is not known until all fragments fit.
        return;
    }
    uint primitive = primitive_and_view.x;
    uint view = primitive_and_view.y;
    uint resolution = abuffer_resolution(abuffer_built, view);
    ivec2 place = ivec2(gl_FragCoord.xy) - 1;
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    if (!triangle_has_area(a, b, c)) {
        return;
    }
    vec3 sides = max(a, max(b, c)) - min(a, min(b, c));
    abuffer_view_vertices(abuffer_built, primitive, view, a, b, c);
    float half_side = 1.0 / float(resolution) + abuffer_fringe_margin(abuffer_built, a, b, c, resolution);
    vec3 center = coverage_center(place, resolution);
    vec2 depths;
    CellCoverage coverage;
    if (!overlap_at(ABUFFER_HEADER(abuffer_built).near_size, overlap_begin(a, b, c), center, half_side, depths)
        || coverage_at_center(a, b, c, place, resolution, coverage)) {
        return;
    }
    uint cell = abuffer_cell(abuffer_built, view, place);
    float width = abuffer_cell_slope(abuffer_built, view) * depths.x;
    // What rises steeply, or reaches behind the eye, is kept for itself.
    if (depths.y - depths.x <= ABUFFER_FRINGE_RISE * width && min(a.z, min(b.z, c.z)) > 0.0) {
        vec3 direction = vec3(triangle_nearest_point(a.xy / a.z, b.xy / b.z, c.xy / c.z, center.xy), 1.0);
        float z = clamp(plane_depth(a, b, c, direction), depths.x, depths.y);
        // What is far smaller than a cell is not taken for a surface that is near for a cell only.
        float size = min(width, max(sides.x, max(sides.y, sides.z)));
        if (is_stood_for(view, cell, direction, z, FRINGE_DEPTH * size)) {
            return;
        }
    }
    abuffer_mark(abuffer_built, primitive);
    fringe_add(abuffer_built, cell, primitive);
}

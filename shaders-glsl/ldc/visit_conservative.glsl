// Puts a triangle into the conservative list of a cell that it reaches into without covering the centre, if
// no fragment of the cell represents the triangle; the same for every builder. Such cells are at edges
// towards triangles of another view, at silhouettes, and where the triangle is smaller than a cell.
// Reads: geometry, header, lists, depths, payload. Writes: heads, conservative lists, blocks,
// header.conservative_demand, header.corrupted.
// Source: not in the paper, in which rays pass between the cells of the views there.
#ifndef LDC_VISIT_CONSERVATIVE_GLSL
#define LDC_VISIT_CONSERVATIVE_GLSL

#include "ldc/blocks.glsl"
#include "ldc/covered.glsl"
#include "ldc/conservative.glsl"

// True if a fragment of the cell represents a triangle there. The fragment must be of the same draw, and its
// plane must pass within `close` metres of a point of the triangle, in depth. Another draw may have another
// material: a lamp let into a ceiling is not the ceiling.
bool ldc_is_stood_for(
    AxisView view, uint cell, uint primitive, vec2 point, float z_point, float z_center, float close) {
    uvec2 list = ldc_list(build.structure, cell, ldc_places(build.structure));
    if (list.y - list.x > CONSERVATIVE_LIMIT) {
        return false;
    }
    // The depth of each plane changes by at most one cell between the point and the centre.
    float window = 2.0 * view.cell + close + ldc_depth_rounding(build.structure);
    uint draw = geometry_draw(primitive);
    for (uint place = list.x; place < list.y; place++) {
        if (abs(ldc_depth(build.structure, place) - z_center) > window) {
            continue;
        }
        vec3 a;
        vec3 b;
        vec3 c;
        uint other = ldc_primitive(build.structure, place);
        ldc_view_vertices(view, other, a, b, c);
        if (abs(axis_plane_depth(a, b, c, point) - z_point) <= close && geometry_draw(other) == draw) {
            return true;
        }
    }
    return false;
}

// Visits a cell for a triangle, which may also miss the cell.
void ldc_visit_conservative(uint primitive, uint axis, ivec2 place) {
    if (!ldc_fragments_fit(build.structure)) {
        // Which fragments could represent a triangle is unknown until all fragments fit.
        return;
    }
    AxisView view = ldc_built_view(axis);
    if (!axis_has_cell(view.resolution, place)) {
        return;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    ldc_view_vertices(view, primitive, a, b, c);
    float z;
    vec2 barycentrics;
    if (!axis_reaches_into(view, a, b, c, place) || axis_at_center(view, a, b, c, place, z, barycentrics)) {
        return;
    }
    float z_nearest = min(a.z, min(b.z, c.z));
    float z_farthest = max(a.z, max(b.z, c.z));
    vec2 center = axis_center(view, place).xy;
    vec2 point = triangle_nearest_point(a.xy, b.xy, c.xy, center);
    float z_point = clamp(axis_plane_depth(a, b, c, point), z_nearest, z_farthest);
    float z_center = axis_plane_depth(a, b, c, center);
    uint cell = ldc_cell(build.structure, view.axis, place);
    // The distance is in units of the triangle where that is smaller than a cell: a surface that is close
    // only in units of the cell does not represent a far smaller triangle.
    vec3 sides = max(a, max(b, c)) - min(a, min(b, c));
    float size = min(view.cell, max(sides.x, max(sides.y, sides.z)));
    if (ldc_is_stood_for(view, cell, primitive, point, z_point, z_center, CONSERVATIVE_DEPTH * size)) {
        return;
    }
    float extent = axis_extent(view, a, b, c);
    // These are the depths of the part of the triangle within the cell.
    vec2 depths = max(clamp(z_center + vec2(-extent, extent), z_nearest, z_farthest), vec2(0.0));
    ldc_widen_blocks(build.structure, view.axis, place, depths.x, depths.y);
    conservative_add(build.structure, cell, primitive, depths);
}

#endif

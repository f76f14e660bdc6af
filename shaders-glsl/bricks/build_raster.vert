// Makes the rasterizer propose, for each triangle and view, at least the columns that the triangle may reach
// into.
// Reads: geometry, header. Writes: nothing.
// One invocation per corner of a triangle, one instance per view.
// Source: DIRT section 3.2. Instances replace the paper's geometry shader, and a triangle with its edges
// moved outwards replaces conservative rasterization.
#version 460
#include "contract/extensions.glsl"
#define STRUCTURE_READ_ONLY
#include "ads/bin_triangle.glsl"
#include "ads/coverage.glsl"
#include "ads/views.glsl"
#include "bricks/header.glsl"
#include "bricks/margin.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"

layout(location = 0) flat out uvec2 primitive_and_view;

// Proposes columns of a view along z. The viewport is a square with as many columns along a side as the view
// has along its longer side, and a border of one column. a, b, c are relative to the centre.
vec4 propose_columns(vec3 a, vec3 b, vec3 c, uint corner) {
    vec3 lower = BRICKS_HEADER(build.structure).cells_lower;
    vec3 per_metre = BRICKS_HEADER(build.structure).cells_per_metre;
    float rounding = BRICKS_HEADER(build.structure).rounding;
    uint side = max(BRICKS_HEADER(build.structure).columns, BRICKS_HEADER(build.structure).rows);
    vec3 p[3] = vec3[3](a, b, c);
    for (int k = 0; k < 3; k++) {
        p[k] = vec3((p[k] - lower).xy * per_metre.xy * (2.0 / float(side)) - 1.0, 1.0);
    }
    // The margin is half a column, plus the reach of columns beyond their sides, plus 1/32 of a column for
    // the sub-pixel grid of the hardware and as much for rounding.
    float margin = 0.5 + rounding * max(per_metre.x, per_metre.y) + 1.0 / 16.0;
    return coverage_proposal_within(p[0], p[1], p[2], corner, side, margin * 2.0 / float(side));
}

// Proposes columns of a face of a cube. a, b, c are in face space.
vec4 propose_face_columns(vec3 a, vec3 b, vec3 c, uint corner) {
    BricksGrid grid = bricks_grid(build.structure);
    float nearest = min(a.z, min(b.z, c.z));
    // The margin covers the centre of every column that the triangle reaches into, and 1/32 of a column more
    // for the sub-pixel grid of the hardware.
    float margin = 1.0 / float(grid.columns) + bricks_margin(grid, nearest) + 1.0 / (16.0 * float(grid.columns));
    return coverage_proposal_within(a, b, c, corner, grid.columns, margin);
}

void main() {
    uint primitive = uint(gl_VertexIndex) / 3u;
    uint corner = uint(gl_VertexIndex) % 3u;
    uint view = uint(gl_InstanceIndex);
    primitive_and_view = uvec2(primitive, view);
    vec3 a;
    vec3 b;
    vec3 c;
    if (!bin_corners(BRICKS_HEADER(build.structure).centre, primitive, a, b, c)) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    } else if (BRICKS_VIEWS == BRICKS_VIEWS_AXES) {
        gl_Position = propose_columns(a, b, c, corner);
    } else {
        gl_Position = propose_face_columns(face_from_world(a, view), face_from_world(b, view), face_from_world(c, view), corner);
    }
}

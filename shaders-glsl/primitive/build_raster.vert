// Makes the rasterizer propose, for each triangle and face, at least the cells that the triangle may reach
// into.
// Reads: geometry, header. Writes: nothing.
// One invocation per corner of a triangle, one instance per face.
// Source: DIRT section 3.2. Instances replace the paper's geometry shader, and a triangle with its edges
// moved outwards replaces conservative rasterization, unless PRIMITIVE_COVERAGE_EXTENSION asks for that.
#version 460
#include "contract/extensions.glsl"
#define STRUCTURE_READ_ONLY
#include "primitive/raster.glsl"

layout(location = 0) flat out uvec2 primitive_and_face;

void main() {
    uint primitive = uint(gl_VertexIndex) / 3u;
    uint corner = uint(gl_VertexIndex) % 3u;
    uint face = uint(gl_InstanceIndex);
    PrimitiveGrid grid = primitive_grid(build.structure);
    uint tiles = grid.tiles;
    primitive_and_face = uvec2(primitive, face);
    vec3 a;
    vec3 b;
    vec3 c;
    primitive_face_vertices(build.structure, primitive, face, a, b, c);
    if (!primitive_is_listed(primitive)) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    } else if (PRIMITIVE_COVERAGE == PRIMITIVE_COVERAGE_CONSERVATIVE) {
        // The margin covers the centre of every cell that the triangle reaches into, and 1/32 of a cell more
        // for the sub-pixel grid of the hardware.
        float margin = 1.0 / float(tiles) + primitive_margin(grid, a, b, c) + 1.0 / (16.0 * float(tiles));
        gl_Position = coverage_proposal_within(a, b, c, corner, tiles, margin);
    } else {
        vec3 p = corner == 0u ? a : (corner == 1u ? b : c);
        float to_clip = float(tiles) / float(tiles + 2u);
        // With z = w / 2 a point is between the near and the far plane for every positive w.
        gl_Position = vec4(p.xy * to_clip, 0.5 * p.z, p.z);
    }
}

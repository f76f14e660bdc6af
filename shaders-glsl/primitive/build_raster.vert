// Proposes, for each triangle and face, the cells that the triangle may reach into.
// Reads: geometry, header. Writes: nothing.
// Source: DIRT section 3.2; instances replace the paper's geometry-shader amplification, and a dilated triangle
// its conservative rasterization, unless PRIMITIVE_COVERAGE_EXTENSION asks for that.
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
        // The margin covers the centre of every cell that the triangle reaches into, with 1/32 of a cell for
        // the hardware's grid.
        float margin = 1.0 / float(tiles) + primitive_margin(grid, a, b, c) + 1.0 / (16.0 * float(tiles));
        gl_Position = coverage_proposal_within(a, b, c, corner, tiles, margin);
    } else {
        vec3 p = corner == 0u ? a : (corner == 1u ? b : c);
        float to_clip = float(tiles) / float(tiles + 2u);
        // z = w / 2 lies between the near and the far plane wherever w is positive.
        gl_Position = vec4(p.xy * to_clip, 0.5 * p.z, p.z);
    }
}

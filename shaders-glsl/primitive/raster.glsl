// What the fragment shaders of the raster builder share.
// Reads: geometry, header. Writes: nothing.
// Each draw has one instance per face. The builder has no attachments and thus no layers: the number of the
// face is a varying.
#ifndef PRIMITIVE_RASTER_GLSL
#define PRIMITIVE_RASTER_GLSL

#include "primitive/corner_depths.glsl"
#include "primitive/names.glsl"
#include "ads/build_constants.glsl"

// Finds the cell of a fragment, and the triangle's depths there. Returns false if the cell does not list the
// triangle.
bool primitive_fragment(uint primitive, uint face, vec4 frag_coord, out uint cell, out vec2 depths) {
    PrimitiveGrid grid = primitive_grid(build.structure);
    ivec2 place = ivec2(frag_coord.xy) - 1;
    cell = cell_index(face, place, grid.tiles);
    vec3 a;
    vec3 b;
    vec3 c;
    primitive_face_vertices(build.structure, primitive, face, a, b, c);
    if (PRIMITIVE_COVERAGE == PRIMITIVE_COVERAGE_HARDWARE) {
        // With this coverage a triangle is also listed where the test above fails, and a triangle that covers
        // no centre is in no list.
        if (!primitive_overlap(grid, a, b, c, place, depths)) {
            depths = vec2(1.0 / frag_coord.w);
        }
        if (PRIMITIVE_DEPTHS == PRIMITIVE_DEPTHS_CORNERS) {
            depths = primitive_corner_depths(grid, a, b, c, place);
        }
        return frag_coord.w > 0.0;
    }
    return primitive_reaches(grid, a, b, c, place, depths);
}

#endif

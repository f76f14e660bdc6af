// What: the draw of the build: one instance a face, triangles pulled from the geometry.
// Reads: geometry, header. Writes: nothing.
// Without attachments no layers are needed: the face travels as a varying.
#ifndef ABUFFER_RASTER_GLSL
#define ABUFFER_RASTER_GLSL

#include "ads/geometry.glsl"
#include "ads/coverage.glsl"
#include "abuffer/header.glsl"

layout(push_constant, scalar) uniform AbufferBuildConstants {
    AbufferRef abuffer_built;
};

// The corners of a triangle as a face sees them.
void abuffer_face_vertices(uint primitive, uint face, out vec3 a, out vec3 b, out vec3 c) {
    geometry_vertices(primitive, a, b, c);
    precise vec3 eye = ABUFFER_HEADER(abuffer_built).eye;
    a = face_from_world(a - eye, face);
    b = face_from_world(b - eye, face);
    c = face_from_world(c - eye, face);
}

// What a fragment invocation finds in its cell; false where the triangle does not cover it.
bool abuffer_fragment(uint primitive, uint face, vec4 frag_coord, out uint cell, out CellCoverage coverage) {
    uint resolution = ABUFFER_HEADER(abuffer_built).resolution;
    ivec2 place = ivec2(frag_coord.xy) - 1;
    cell = cell_index(face, place, resolution);
    vec3 a;
    vec3 b;
    vec3 c;
    abuffer_face_vertices(primitive, face, a, b, c);
    if (ABUFFER_COVERAGE == ABUFFER_COVERAGE_EXACT) {
        return coverage_at_center(a, b, c, place, resolution, coverage);
    }
    vec3 direction = coverage_center(place, resolution);
    coverage.z = 1.0 / frag_coord.w;
    float t;
    if (!triangle_plane(vec3(0.0), direction, a, b, c, t, coverage.barycentrics)) {
        coverage.barycentrics = vec2(1.0 / 3.0);
    }
    coverage.barycentrics = clamp(coverage.barycentrics, 0.0, 1.0);
    coverage.extent = coverage_extent(a, b, c, direction, coverage.z, resolution);
    return coverage.z > 0.0;
}

#endif

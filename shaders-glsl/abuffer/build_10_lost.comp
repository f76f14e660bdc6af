// Counts the triangles that rays cannot hit: triangles that have an area, but that no cell of any view keeps.
// Reads: header, bounds, geometry. Writes: header.lost. One invocation per word of marks.
// Source: not in the paper, which mentions edge-on triangles as a limitation.
#version 460
#include "contract/extensions.glsl"
#include "ads/geometry.glsl"
#include "ads/triangle.glsl"
#include "abuffer/accessors.glsl"
#include "abuffer/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint word = build_invocation();
    uint triangles = min(geometry_triangle_count(), ABUFFER_HEADER(build.structure).triangles);
    if (32u * word >= triangles) {
        return;
    }
    uint marks = 0u;
    for (uint set = 0u; set < abuffer_mark_sets(); set++) {
        marks |= ABUFFER_POOL(build.structure, bounds)[abuffer_marks(build.structure) + set * abuffer_mark_words(build.structure) + word];
    }
    uint lost = 0u;
    for (uint bit = 0u; bit < min(32u, triangles - 32u * word); bit++) {
        if ((marks & 1u << bit) == 0u) {
            vec3 a;
            vec3 b;
            vec3 c;
            geometry_vertices(32u * word + bit, a, b, c);
            lost += triangle_has_area(a, b, c) ? 1u : 0u;
        }
    }
    if (lost != 0u) {
        atomicAdd(ABUFFER_HEADER(build.structure).lost, lost);
    }
}

// Replaces the triangle of each fragment by colour and normal of its surface. Runs with payload attributes
// only, and after sorting, peeling and conservative lists, which need triangles.
// Reads: geometry, header, lists, payload, the scene. Writes: payload. One invocation per place.
// Source: Bürger et al. section 1.2.1, where a second target of each layer holds colour and texture.
// A cube may be in a space of its own, away from where the scene is posed. The pass then turns normals from
// the posed scene into that space. If there is no map between the two, fragments keep their triangles, as
// fragments that emit always do.
#version 460
#include "contract/extensions.glsl"
#include "ads/rigid.glsl"
#include "scene/stored_surface.glsl"
#include "ldc/accessors.glsl"
#include "ldc/covered.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

// Returns the place behind the last one of a list.
uint list_end(uint list) {
    return LDC_POOL(build.structure, lists)[list];
}

#include "ads/list_of_place.glsl"
#include "ads/build_invocation.glsl"

// Returns colour and normal of a triangle whose corners are in the space of the cube.
uvec2 rigid_attributes(uint primitive, vec2 barycentrics) {
    GeometryRigid map = rigid_map();
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    if (isinf(map.error)) {
        return stored_pack_triangle(stored_source_at(primitive, barycentrics, a, b, c));
    }
    // The map is scaled to unit size, so that its determinant stays within range.
    mat3 posed_from_built = inverse(mat3(map.x, map.y, map.z) / map.stretch);
    float grown = 1.0 / map.stretch;
    a = posed_from_built * (grown * (a - map.offset)) + map.centre;
    b = posed_from_built * (grown * (b - map.offset)) + map.centre;
    c = posed_from_built * (grown * (c - map.offset)) + map.centre;
    Surface surface = stored_source_at(primitive, barycentrics, a, b, c);
    surface.normal = normalize(surface.normal * posed_from_built);
    return stored_pack(surface);
}

void main() {
    uint place = build_invocation();
    uint places = ldc_places(build.structure);
    if (!ldc_fragments_fit(build.structure) || place >= places) {
        return;
    }
    uint list = list_of_place(ldc_cell_count(build.structure), place);
    uvec2 range = ldc_list(build.structure, list, places);
    uint primitive = ldc_primitive(build.structure, place);
    // Layers that are not peeled yet have no triangle.
    if (place < range.x || place >= range.y || primitive == PRIMITIVE_NONE) {
        return;
    }
    uint resolution = LDC_HEADER(build.structure).resolution;
    uint in_view = list % (resolution * resolution);
    ivec2 cell = ivec2(in_view % resolution, in_view / resolution);
    float z;
    vec2 barycentrics;
    if (ldc_fragment(ldc_built_view(list / (resolution * resolution)), primitive, cell, z, barycentrics)) {
        uvec2 words = LDC_RIGID == 0u ? stored_pack(stored_source(primitive, barycentrics))
            : rigid_attributes(primitive, barycentrics);
        ldc_set_attributes(build.structure, place, words);
    }
}

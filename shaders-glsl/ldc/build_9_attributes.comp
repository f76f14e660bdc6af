// What: replaces the triangle of each fragment by colour and normal, as seen along the triangle's
// normal. Sorting, peeling and conservative lists need triangles, so it comes last. Payload attributes only.
// Reads: geometry, header, lists, payload, the scene. Writes: payload.
// Source: Bürger et al. section 1.2.1, where a second target of each layer holds colour and texture.
#version 460
#include "contract/extensions.glsl"
#include "scene/stored_surface.glsl"
#include "ldc/accessors.glsl"
#include "ldc/covered.glsl"

layout(local_size_x = LDC_GROUP_SIZE) in;

uint list_end(uint list) {
    return LDC_LISTS(build.structure)[list];
}

#include "ads/list_of_place.glsl"

void main() {
    uint place = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * LDC_GROUP_SIZE + gl_GlobalInvocationID.x;
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
        ldc_set_attributes(build.structure, place, stored_pack(stored_source(primitive, barycentrics)));
    }
}

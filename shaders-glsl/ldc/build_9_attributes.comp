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
    return LDC_LISTS(ldc_built)[list];
}

#include "ads/list_of_place.glsl"

void main() {
    uint place = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * LDC_GROUP_SIZE + gl_GlobalInvocationID.x;
    uint places = ldc_places(ldc_built);
    if (!ldc_fragments_fit(ldc_built) || place >= places) {
        return;
    }
    uint list = list_of_place(ldc_cell_count(ldc_built), place);
    uvec2 range = ldc_list(ldc_built, list, places);
    uint primitive = ldc_primitive(ldc_built, place);
    // Layers that are not peeled yet have no triangle.
    if (place < range.x || place >= range.y || primitive == PRIMITIVE_NONE) {
        return;
    }
    uint resolution = LDC_HEADER(ldc_built).resolution;
    uint in_view = list % (resolution * resolution);
    ivec2 cell = ivec2(in_view % resolution, in_view / resolution);
    float z;
    vec2 barycentrics;
    if (ldc_fragment(ldc_built_view(list / (resolution * resolution)), primitive, cell, z, barycentrics)) {
        ldc_set_attributes(ldc_built, place, stored_pack(stored_source(primitive, barycentrics)));
    }
}

// What: puts what is shaded at each fragment in place of its triangle or beside it, as seen along the triangle's normal.
// Payloads other than index only.
// Reads: geometry, header, lists, fragments, the scene. Writes: fragments.
// Source: Hu et al. section 3.1; Frid Kastrati and Goswami section 3.2.
#version 460
#include "contract/extensions.glsl"
#include "voxel/attributes.glsl"
#include "voxel/raster.glsl"

layout(local_size_x = VOXEL_GROUP_SIZE) in;

uint list_end(uint list) {
    return VOXEL_LISTS(voxel_built)[list];
}

#include "ads/list_of_place.glsl"

void main() {
    uint place = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * VOXEL_GROUP_SIZE + gl_GlobalInvocationID.x;
    uint demand = VOXEL_HEADER(voxel_built).demand;
    if (demand > VOXEL_HEADER(voxel_built).capacity || place >= demand) {
        return;
    }
    uint list = list_of_place(voxel_list_count(voxel_built), place);
    uvec2 range = voxel_list(voxel_built, list);
    // What is left of a list's last page holds none.
    if (place < range.x || place >= range.y) {
        return;
    }
    uint resolution = VOXEL_HEADER(voxel_built).resolution;
    uint in_view = list % (resolution * resolution);
    ivec2 cell = ivec2(in_view % resolution, in_view / resolution);
    uint primitive = voxel_word(voxel_built, place, 1u);
    VoxelFound found;
    if (voxel_fragment(primitive, list / (resolution * resolution), cell, found)) {
        uvec3 words = voxel_pack_attributes(primitive, found.barycentrics);
        for (uint word = 0u; word < 3u; word++) {
            voxel_set_word(voxel_built, place, word + 1u, words[word]);
        }
    }
}

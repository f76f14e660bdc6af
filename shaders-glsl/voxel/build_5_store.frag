// What: stores each fragment: its depth, and its triangle or what is shaded there, as seen along the triangle's normal. Where
// views keep everything and nothing was counted before, also the normals of voxels.
// Reads: geometry, header, voxels (one axis a voxel), with PAYLOAD_ATTRIBUTES the scene. Writes: lists, fragments, header;
// voxels and normals.
// Source: Hu et al. section 3.1, the one geometry pass; Frid Kastrati and Goswami section 3.2: in the view of its voxel's axis
// only.
#version 460
#include "contract/extensions.glsl"
#include "voxel/raster.glsl"
#include "voxel/mask.glsl"
#ifdef PAYLOAD_ATTRIBUTES
#include "voxel/attributes.glsl"
#endif

layout(location = 0) flat in uvec2 primitive_and_axis;

void main() {
    uint primitive = primitive_and_axis.x;
    uint axis = primitive_and_axis.y;
    VoxelFound found;
    if (!voxel_fragment(primitive, axis, voxel_cell_at_fragment(gl_FragCoord), found)
        || !voxel_mask_keeps(primitive, found.barycentrics) || !voxel_keeps(voxel_built, found.voxel, axis)) {
        return;
    }
    if (VOXEL_AXES == VOXEL_AXES_ALL && !voxel_contiguous()) {
        voxel_fill(primitive, found);
    }
    uint place = voxel_allocate(voxel_built, found.list);
    if (place == VOXEL_NO_PLACE) {
        return;
    }
    voxel_set_word(voxel_built, place, 0u, floatBitsToUint(found.z));
#ifdef PAYLOAD_ATTRIBUTES
    uvec3 words = voxel_pack_attributes(primitive, found.barycentrics);
    for (uint word = 0u; word < 3u; word++) {
        voxel_set_word(voxel_built, place, word + 1u, words[word]);
    }
#else
    voxel_set_word(voxel_built, place, 1u, primitive);
#endif
    voxel_link(voxel_built, found.list, place);
}

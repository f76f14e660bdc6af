// Processes a triangle in a cell of a view, the same for every builder: counts the fragment, or stores it.
// Reads: geometry, header, with PAYLOAD_ATTRIBUTES the scene; voxels, if a view keeps the fragments of some
// voxels only. Writes: lists, fragments, header, voxels, normals.
// Source: Hu et al. section 3.1, the one geometry pass; Frid Kastrati and Goswami section 3.2, fragments only
// in the view along the axis of their voxel.
#ifndef VOXEL_VISIT_GLSL
#define VOXEL_VISIT_GLSL

#include "voxel/covered.glsl"
#include "voxel/mask.glsl"
#ifdef PAYLOAD_ATTRIBUTES
#include "voxel/attributes.glsl"
#endif

// Counts a fragment that the cell keeps. If every view keeps every triangle, it also marks the voxel.
void voxel_visit_count(uint primitive, uint axis, ivec2 cell) {
    VoxelFound found;
    if (!voxel_fragment(primitive, axis, cell, found) || !voxel_mask_keeps(primitive, found.barycentrics)) {
        return;
    }
    if (VOXEL_AXES == VOXEL_AXES_ALL) {
        voxel_fill(primitive, found);
    } else if (!voxel_keeps(build.structure, found.voxel, axis)) {
        return;
    }
    voxel_list_count_one(build.structure, found.list);
}

// Stores a fragment that the cell keeps. Marks the voxel as voxel_visit_count does, if fragments are not
// counted.
void voxel_visit_store(uint primitive, uint axis, ivec2 cell) {
    VoxelFound found;
    if (!voxel_fragment(primitive, axis, cell, found) || !voxel_mask_keeps(primitive, found.barycentrics)
        || !voxel_keeps(build.structure, found.voxel, axis)) {
        return;
    }
    if (VOXEL_AXES == VOXEL_AXES_ALL && !voxel_contiguous()) {
        voxel_fill(primitive, found);
    }
    uint place = voxel_allocate(build.structure, found.list);
    if (place == VOXEL_NO_PLACE) {
        return;
    }
    voxel_set_word(build.structure, place, 0u, floatBitsToUint(found.z));
#ifdef PAYLOAD_ATTRIBUTES
    uvec3 words = voxel_pack_attributes(primitive, found.barycentrics);
    for (uint word = 0u; word < 3u; word++) {
        voxel_set_word(build.structure, place, word + 1u, words[word]);
    }
    if (VOXEL_IDS != 0u) {
        voxel_set_word(build.structure, place, 4u, primitive);
    }
#else
    voxel_set_word(build.structure, place, 1u, primitive);
#endif
    voxel_link(build.structure, found.list, place);
}

#endif

// Finds the surface at a hit of the axis A-buffers.
// Reads: with payload index the scene; with other payloads fragments, and the scene for fragments that emit.
// Writes: header.corrupted.
// With payload index, a hit names a triangle and the barycentrics of the hit point on the triangle's plane.
// The point may lie outside the triangle by up to a cell, or a voxel. It is then shaded as the nearest edge
// of the triangle, but its position stays on the ray.
#ifndef VOXEL_SURFACE_GLSL
#define VOXEL_SURFACE_GLSL

#include "voxel/accessors.glsl"
#include "voxel/attributes.glsl"

Surface voxel_surface_at(VoxelRef s, Ray ray, Hit hit) {
    bool stored = VOXEL_PAYLOAD != VOXEL_PAYLOAD_INDEX;
    float size = voxel_leaf_size(s);
    if (stored) {
        uint place = floatBitsToUint(hit.a);
        if (place >= voxel_stored(s)) {
            // A hit with an invalid fragment is counted as corrupted.
            atomicAdd(VOXEL_HEADER(s).corrupted, 1u);
            return surface_miss(ray);
        }
        uvec3 words = uvec3(voxel_word(s, place, 1u), voxel_word(s, place, 2u), voxel_word(s, place, 3u));
        uint emitter = voxel_emitter(hit, words);
        if (emitter == PRIMITIVE_NONE) {
            return voxel_attributes_surface(words, ray, hit, size);
        }
        hit = stored_triangle_hit(emitter, ray, hit.t);
    }
    // With parity, the position is known to within a cell; with voxels as leaves, to within a voxel.
    bool is_near = stored || VOXEL_ACCEPT == VOXEL_ACCEPT_PARITY || VOXEL_LEAVES == VOXEL_LEAVES_VOXELS;
    return stored_triangle_surface(ray, hit, is_near, size);
}

#endif

// What: the surface at a hit of the axis A-buffers.
// Reads: the scene (payload index), fragments (the others). Writes: header.corrupted.
// A hit names a triangle and the barycentrics of the point on its plane; they may lie outside the triangle by up to a
// cell and are taken to its nearest edge for shading, while the position stays on the ray.
#ifndef VOXEL_SURFACE_GLSL
#define VOXEL_SURFACE_GLSL

#include "scene/surface.glsl"
#include "voxel/accessors.glsl"
#include "voxel/attributes.glsl"

// The surface of the fragment that a hit names. One that names none is counted.
Surface voxel_stored_surface(VoxelRef s, Ray ray, Hit hit) {
    uint place = floatBitsToUint(hit.a);
    if (place >= voxel_stored(s)) {
        atomicAdd(VOXEL_HEADER(s).corrupted, 1u);
        return surface_miss(ray);
    }
    uvec3 words = uvec3(voxel_word(s, place, 1u), voxel_word(s, place, 2u), voxel_word(s, place, 3u));
    return voxel_attributes_surface(words, ray, hit, VOXEL_HEADER(s).cell);
}

Surface voxel_surface_at(VoxelRef s, Ray ray, Hit hit) {
    if (VOXEL_PAYLOAD != VOXEL_PAYLOAD_INDEX) {
        return voxel_stored_surface(s, ray, hit);
    }
    vec2 inside = max(vec2(hit.a, hit.b), vec2(0.0));
    inside /= max(inside.x + inside.y, 1.0);
    Surface surface = scene_surface(ray, hit.t, hit.primitive, inside);
    bool beside = any(notEqual(inside, vec2(hit.a, hit.b)));
    if (beside || VOXEL_ACCEPT == VOXEL_ACCEPT_PARITY) {
        surface.position = ray.origin + hit.t * ray.direction;
        vec3 size = abs(ray.origin) + abs(hit.t * ray.direction);
        surface.position_error = max(surface.position_error, 4.8e-7 * max(size.x, max(size.y, size.z)));
    }
    if (VOXEL_ACCEPT == VOXEL_ACCEPT_PARITY) {
        // The point is known to a cell.
        surface.position_error = max(surface.position_error, VOXEL_HEADER(s).cell);
    }
    return surface;
}

#endif

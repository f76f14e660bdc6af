// Finds the surface at a hit of the A-buffer.
// Reads: the scene, with payload index and for fragments that emit; otherwise the fragment's words. Writes:
// nothing.
// With payload index, a hit names a triangle, and the barycentrics of the hit point on the triangle's plane.
#ifndef ABUFFER_SURFACE_GLSL
#define ABUFFER_SURFACE_GLSL

#include "contract/stored_hit.glsl"
#include "abuffer/nodes.glsl"
#include "abuffer/attributes.glsl"
#include "abuffer/stored_plane.glsl"

// Returns the width of a cell at a point, metres. The A-buffer loses smaller details.
float abuffer_footprint(AbufferRef s, vec3 position) {
    vec3 p = abs(position - ABUFFER_HEADER(s).eye);
    float cube = ABUFFER_HAS_CUBE ? abuffer_cell_slope(s, 0u) : 0.0;
    float camera = ABUFFER_HAS_CAMERA ? abuffer_cell_slope(s, ABUFFER_CAMERA) : 0.0;
    return max(cube, camera) * max(p.x, max(p.y, p.z));
}

Surface abuffer_surface_at(AbufferRef s, Ray ray, Hit hit) {
    bool stored = stored_hit_is(hit);
    float footprint = abuffer_footprint(s, ray.origin + hit.t * ray.direction);
    uvec4 words = uvec4(0u);
    bool emits = false;
    if (stored) {
        words = abuffer_payload(s, floatBitsToUint(hit.a));
        emits = ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_ATTRIBUTES && stored_emits(words.xy);
    }
    if (!stored || emits) {
        if (emits) {
            hit = stored_triangle_hit(words.y, ray, hit.t);
        }
        return stored_triangle_surface(ray, hit, emits, footprint);
    }
    if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_NORMAL) {
        return stored_shape(stored_unpack_normal(words.x), ray, hit.t, footprint);
    }
    if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_PLANE) {
        return stored_shape(abuffer_plane_normal(words), ray, hit.t, footprint);
    }
    return abuffer_attributes_surface(words, ray, hit.t, footprint);
}

#endif

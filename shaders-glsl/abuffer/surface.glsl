// What: the surface at a hit of the A-buffer.
// Reads: the scene (payload index) or the fragment's own words (the other payloads). Writes: nothing.
// With payload index the hit names a triangle and the barycentrics of the point on its plane.
#ifndef ABUFFER_SURFACE_GLSL
#define ABUFFER_SURFACE_GLSL

#include "contract/stored_hit.glsl"
#include "scene/plane_surface.glsl"
#include "abuffer/nodes.glsl"
#include "abuffer/attributes.glsl"
#include "abuffer/stored_plane.glsl"

// The size of a cell at a point: what the A-buffer cannot tell apart, metres.
float abuffer_footprint(AbufferRef s, vec3 position) {
    vec3 p = abs(position - ABUFFER_HEADER(s).eye);
    float cube = ABUFFER_HAS_CUBE ? abuffer_cell_slope(s, 0u) : 0.0;
    float camera = ABUFFER_HAS_CAMERA ? abuffer_cell_slope(s, ABUFFER_CAMERA) : 0.0;
    return max(cube, camera) * max(p.x, max(p.y, p.z));
}

Surface abuffer_surface_at(AbufferRef s, Ray ray, Hit hit) {
    if (!stored_hit_is(hit)) {
        return plane_surface(ray, hit);
    }
    uint link = floatBitsToUint(hit.a);
    uvec4 words = abuffer_payload(s, link);
    float footprint = abuffer_footprint(s, ray.origin + hit.t * ray.direction);
    if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_NORMAL) {
        return stored_shape(stored_unpack_normal(words.x), ray, hit.t, footprint);
    }
    if (ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_PLANE) {
        return stored_shape(uintBitsToFloat(words.xyz), ray, hit.t, footprint);
    }
    return abuffer_attributes_surface(words, ray, hit.t, footprint);
}

#endif

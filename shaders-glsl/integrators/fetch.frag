// Computes the surfaces of those hits in the list of this pixel that lie on the triangle drawn.
// Reads: lists, rays and hits of the queue, geometry, scene. Writes: surfaces of the queue, its count of
// slots not ready.
// One invocation per triangle, part of a list and pixel of a face that fetch.vert proposes. It reads one part
// of the list, because the loops of an invocation are bounded.
// Source: DIRT section 4.2.2, fetch pass.
#version 460
#include "contract/extensions.glsl"
#include "integrators/fetch.glsl"
#include "scene/surface.glsl"

layout(location = 0) flat in uvec3 primitive_face_part;

void main() {
    uint primitive = primitive_face_part.x;
    // A face has a border of one pixel, which contains no hits.
    ivec2 place = ivec2(gl_FragCoord.xy) - 1;
    if (any(lessThan(place, ivec2(0))) || any(greaterThanEqual(place, ivec2(fetch.side)))) {
        return;
    }
    uint pixel = (primitive_face_part.y * fetch.side + uint(place.y)) * fetch.side + uint(place.x);
    uvec2 list = fetch_pixels[pixel];
    uint first = primitive_face_part.z * FETCH_PART;
    uint end = min(list.y, first + FETCH_PART);
    uint fetched = 0u;
    for (uint i = first; i < end; i++) {
        uint slot = fetch_lists[list.x + i];
        Hit hit = queue_hit(slot);
        if (hit.primitive == primitive) {
            queue_set_surface(slot, scene_surface(queue_ray(slot), hit.t, primitive, vec2(hit.a, hit.b)));
            fetched++;
        }
    }
    if (fetched > 0u) {
        atomicAdd(queue_header.not_ready, 0u - fetched);
    }
}

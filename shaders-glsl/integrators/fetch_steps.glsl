// The three steps that put hits into lists: counts, places of lists, entries.
// Reads: hits of the queue, geometry, frame. Writes: lists, mask, counts, surfaces of misses.
// Source: DIRT section 4.2.1, final storage; here the mask is one of triangles.
#ifndef INTEGRATORS_FETCH_STEPS_GLSL
#define INTEGRATORS_FETCH_STEPS_GLSL

#include "integrators/fetch.glsl"
#include "scene/accessors.glsl"

// Returns the position of a hit relative to the centre. Corners are made relative first, so that the result
// is rounded relative to its own size.
vec3 hit_from_centre(Hit hit, vec3 centre) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(hit.primitive, a, b, c);
    return (1.0 - hit.a - hit.b) * (a - centre) + hit.a * (b - centre) + hit.b * (c - centre);
}

// Counts the hit of a slot in the list of its pixel, and marks the triangle that was hit.
void count(uint slot) {
    Hit hit = queue_hit(slot);
    if (hit.primitive == PRIMITIVE_NONE) {
        queue_surfaces[slot].valid = 0u;
        queue_surfaces[slot].primitive = PRIMITIVE_NONE;
        return;
    }
    atomicAdd(queue_header.not_ready, 1u);
    atomicAdd(fetch_header.hits, 1u);
    if (hit.primitive >= geometry_triangle_count()) {
        return;
    }
    uint pixel = fetch_pixel(hit_from_centre(hit, scene_frame().camera_position));
    uint place = atomicAdd(fetch_pixels[pixel].y, 1u);
    fetch_slots[slot] = uvec2(pixel, place);
    if (place == 0u) {
        atomicAdd(fetch_header.pixels, 1u);
    }
    if (place % FETCH_PART == 0u) {
        atomicMax(fetch_header.instance_count, VIEW_FACES * (place / FETCH_PART + 1u));
    }
    atomicMax(fetch_header.longest, place + 1u);
    uint bit = 1u << (hit.primitive & 31u);
    if ((atomicOr(fetch_mask[hit.primitive >> 5], bit) & bit) == 0u) {
        atomicAdd(fetch_header.triangles, 1u);
    }
}

// Gives the list of a pixel its place.
void place_list(uint pixel) {
    if (pixel == 0u) {
        fetch_header.vertex_count = 3u * geometry_triangle_count();
    }
    uint hits = pixel < VIEW_FACES * fetch.side * fetch.side ? fetch_pixels[pixel].y : 0u;
    if (hits > 0u) {
        fetch_pixels[pixel].x = atomicAdd(fetch_header.listed, hits);
    }
}

// Stores a slot in the list of its hit's pixel.
void store(uint slot) {
    if (queue_hit(slot).primitive < geometry_triangle_count()) {
        uvec2 found = fetch_slots[slot];
        fetch_lists[fetch_pixels[found.x].x + found.y] = slot;
    }
}

#endif

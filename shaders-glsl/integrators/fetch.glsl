// Shared parts of the passes that fetch surfaces by drawing: lists of hits for each pixel of a cube around
// the camera, a mask of the triangles that have hits, and the pixel of the cube in which a point lies.
// Reads, writes: lists, mask, counts. Stages that only read define FETCH_READ_ONLY.
// Source: DIRT sections 4.2.1, final storage, and 4.2.2, fetch pass. Lists are contiguous, so that a fragment
// can read a part of a list.
#ifndef INTEGRATORS_FETCH_GLSL
#define INTEGRATORS_FETCH_GLSL

#include "ads/geometry.glsl"
#include "ads/placement.glsl"
#include "ads/queue.glsl"
#include "ads/views.glsl"
#include "integrators/constants.glsl"

#ifndef INTEGRATOR_SET
#define INTEGRATOR_SET 1
#endif

#ifdef FETCH_READ_ONLY
#define FETCH_ACCESS readonly
#else
#define FETCH_ACCESS
#endif

// Arguments of the draw, and counts. Shared, 36 bytes. Counts of hits, triangles and pixels add up over all
// fetches since the reset, modulo 2^32.
struct FetchHeader {
    uint vertex_count;    // of the draw: three vertices per triangle
    uint instance_count;  // of the draw: one instance per face and part of a list
    uint first_vertex;    // of the draw: 0
    uint first_instance;  // of the draw: 0
    uint listed;          // entries in all lists of this fetch
    uint hits;            // hits whose surface was asked for
    uint triangles;       // triangles with a hit, each once per fetch
    uint pixels;          // pixels of the cube with a hit, each once per fetch
    uint longest;         // hits of the longest list
};

layout(set = INTEGRATOR_SET, binding = 0, scalar) FETCH_ACCESS buffer FetchHeaderBuffer { FetchHeader fetch_header; };
// The list of each pixel: its first entry, and its number of hits.
layout(set = INTEGRATOR_SET, binding = 1, scalar) FETCH_ACCESS buffer FetchPixelBuffer { uvec2 fetch_pixels[]; };
// For each slot of the queue with a hit: the pixel, and the place in the pixel's list.
layout(set = INTEGRATOR_SET, binding = 2, scalar) FETCH_ACCESS buffer FetchSlotBuffer { uvec2 fetch_slots[]; };
// The slots of all lists.
layout(set = INTEGRATOR_SET, binding = 3, scalar) FETCH_ACCESS buffer FetchListBuffer { uint fetch_lists[]; };
// A mask with one bit per triangle.
layout(set = INTEGRATOR_SET, binding = 4, scalar) FETCH_ACCESS buffer FetchMaskBuffer { uint fetch_mask[]; };

// The slots that a pass works on, and the cube onto which triangles are drawn. 12 bytes.
layout(push_constant, scalar) uniform FetchConstants {
    uint domain;          // slots of the queue: the number of first slots, or DOMAIN_SELECTED
    uint side;            // pixels along a side of a face
    uint step;            // step of the pass: FETCH_*
} fetch;

// Returns the largest distance of a computed hit from its triangle, metres. Both are relative to the centre
// of the cube.
float fetch_rounding(vec3 centre) {
    return TRIANGLE_ROUNDING * box_reach(geometry_header.lower - centre, geometry_header.upper - centre);
}

// Returns half the side of the box around the centre in which that distance may be a quarter of a pixel or
// more, metres.
float fetch_near(float rounding) {
    return max(4.0 * float(fetch.side) * rounding, PLACEMENT_SMALLEST);
}

// Returns the pixel of a point that is relative to the centre.
uint fetch_pixel(vec3 point) {
    uint face = face_of(point);
    vec3 p = face_from_world(point, face);
    // A point at the centre may be in any pixel. Triangles that close to the centre are drawn over all
    // pixels.
    vec2 place = p.z > 0.0 ? p.xy / p.z : vec2(0.0);
    ivec2 pixel = clamp(ivec2(floor((0.5 * place + 0.5) * float(fetch.side))), ivec2(0), ivec2(fetch.side) - 1);
    return (face * fetch.side + uint(pixel.y)) * fetch.side + uint(pixel.x);
}

#endif

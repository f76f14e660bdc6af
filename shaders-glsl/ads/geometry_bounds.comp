// Computes the bounds of all triangles, as integer keys, with one atomic operation per workgroup and side.
// Reads: positions and indices of GEOMETRY_SET; if BOUNDS_OF_GATHERED is defined, the indices from which a
// gather pass will make these. Writes: keys in the header of GEOMETRY_SET. They must hold the identities
// before: all bits set in the lower keys, none in the upper keys.
// One invocation per triangle.
#version 460
#include "contract/extensions.glsl"

layout(local_size_x = 64) in;

#define GEOMETRY_WRITTEN
#include "ads/float_keys.glsl"
#ifdef BOUNDS_OF_GATHERED
#include "ads/gathered.glsl"
#define BOUNDS_TRIANGLE(primitive) gathered_triangle(primitive)
#else
#include "ads/geometry.glsl"
#define BOUNDS_TRIANGLE(primitive) geometry_triangle(primitive)
#endif

shared uint shared_keys[6];

void include_corner(vec3 corner) {
    // Corners that are not finite are ignored. The check pass (ads/geometry_check.comp) counts triangles with
    // infinite corners; no ray hits those with NaN.
    if (any(isnan(corner)) || any(isinf(corner))) {
        return;
    }
    [[unroll]] for (int axis = 0; axis < 3; axis++) {
        uint key = key_of(corner[axis]);
        atomicMin(shared_keys[axis], key);
        atomicMax(shared_keys[3 + axis], key);
    }
}

void main() {
    uint thread = gl_LocalInvocationIndex;
    if (thread < 6u) {
        shared_keys[thread] = thread < 3u ? 0xFFFFFFFFu : 0u;
    }
    barrier();
    uint primitive = thread + gl_WorkGroupSize.x * (gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y);
    if (primitive < geometry_triangle_count()) {
        uvec3 vertices = BOUNDS_TRIANGLE(primitive);
        include_corner(geometry_position(vertices.x));
        include_corner(geometry_position(vertices.y));
        include_corner(geometry_position(vertices.z));
    }
    barrier();
    if (thread < 3u) {
        atomicMin(geometry_header.lower_keys[thread], shared_keys[thread]);
        atomicMax(geometry_header.upper_keys[thread], shared_keys[3u + thread]);
    }
}

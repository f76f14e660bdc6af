// Counts the triangles that are not within the bounds that the geometry states, or that have an index of no
// vertex. Structures place cells by the bounds, so such triangles would be lost without notice.
// Reads: positions and indices of GEOMETRY_SET. Writes: header.outside, to which it adds.
// One invocation per triangle.
#version 460
#include "contract/extensions.glsl"

layout(local_size_x = 64) in;

#define GEOMETRY_WRITTEN
#include "ads/geometry.glsl"

// True if a corner is outside the bounds. Corners with NaN are not outside: no ray hits their triangles.
bool is_outside(vec3 corner) {
    return any(lessThan(corner, geometry_header.lower)) || any(greaterThan(corner, geometry_header.upper));
}

void main() {
    uint primitive = gl_LocalInvocationIndex
                   + gl_WorkGroupSize.x * (gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y);
    if (primitive >= geometry_triangle_count()) {
        return;
    }
    bool unknown = any(greaterThanEqual(geometry_triangle(primitive), uvec3(geometry_header.vertex_count)));
    vec3 a, b, c;
    geometry_vertices(primitive, a, b, c);
    if (unknown || is_outside(a) || is_outside(b) || is_outside(c)) {
        atomicAdd(geometry_header.outside, 1u);
    }
}

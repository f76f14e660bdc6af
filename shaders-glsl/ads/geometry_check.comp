// Counts the triangles that reach out of the bounds their geometry states, or have a vertex number that does not
// exist: one invocation per triangle. Structures place cells by the bounds, so such triangles would be lost without
// notice.
// Reads: positions and indices of GEOMETRY_SET. Writes: adds to its header's count.
#version 460
#include "contract/extensions.glsl"

layout(local_size_x = 64) in;

#define GEOMETRY_WRITTEN
#include "ads/geometry.glsl"

// True if a corner is outside the bounds. NaN corners never are: no ray hits their triangles.
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

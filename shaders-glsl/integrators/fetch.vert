// Proposes, for each triangle that has hits and each face of the cube, the pixels whose lists may hold these
// hits.
// Reads: geometry, frame, mask. Writes: nothing. Three vertices per triangle, one instance per face and part
// of a list.
// Source: DIRT section 4.2.2, fetch pass; the dilated triangles of ads/coverage.glsl.
#version 460
#include "contract/extensions.glsl"
#define FETCH_READ_ONLY
#include "ads/coverage.glsl"
#include "integrators/fetch.glsl"
#include "scene/accessors.glsl"

layout(location = 0) flat out uvec3 primitive_face_part;

// True if the box around the triangle reaches into the box of this half side around the centre.
bool is_near(vec3 a, vec3 b, vec3 c, float half_side) {
    return all(lessThanEqual(min(a, min(b, c)), vec3(half_side)))
        && all(greaterThanEqual(max(a, max(b, c)), vec3(-half_side)));
}

void main() {
    uint primitive = uint(gl_VertexIndex) / 3u;
    uint corner = uint(gl_VertexIndex) % 3u;
    uint face = uint(gl_InstanceIndex) % VIEW_FACES;
    primitive_face_part = uvec3(primitive, face, uint(gl_InstanceIndex) / VIEW_FACES);
    if ((fetch_mask[primitive >> 5] & (1u << (primitive & 31u))) == 0u) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    vec3 centre = scene_frame().camera_position;
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    a = face_from_world(a - centre, face);
    b = face_from_world(b - centre, face);
    c = face_from_world(c - centre, face);
    float rounding = fetch_rounding(centre);
    float near = fetch_near(rounding);
    if (is_near(a, b, c, 2.0 * near)) {
        gl_Position = vec4(coverage_rectangle(vec4(-1.0, -1.0, 1.0, 1.0), corner), 0.5, 1.0);
        return;
    }
    // The margin covers the centre of every pixel in which a hit may be: half a pixel from its centre to its
    // sides, rounding, and 1/32 of a pixel for the hardware's sub-pixel grid.
    float margin = (1.0 + 1.0 / 16.0) / float(fetch.side) + 4.0 * rounding / max(min(a.z, min(b.z, c.z)), near);
    gl_Position = coverage_proposal_within(a, b, c, corner, fetch.side, margin);
}

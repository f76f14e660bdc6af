// Proposes, for each triangle, the pixels of a wave whose rays may hit the triangle.
// Reads: geometry, frame. Writes: nothing. Three vertices per triangle.
// Source: the dilated triangles of ads/coverage.glsl; integrators/visibility_bounds.glsl.
#version 460
#include "contract/extensions.glsl"
#include "ads/coverage.glsl"
#include "ads/geometry.glsl"
#include "integrators/visibility_bounds.glsl"

// First and last corner of a rectangle in the area drawn, in pixels. No ray of a pixel outside of it hits the
// triangle.
layout(location = 0) flat out vec4 pixel_bounds;
layout(location = 1) flat out uint primitive;
layout(location = 2) flat out uint covering;

void main() {
    Frame frame = scene_frame();
    Area area = wave_area(frame);
    primitive = uint(gl_VertexIndex) / 3u;
    uint corner = uint(gl_VertexIndex) % 3u;
    vec3 corners[3];
    geometry_vertices(primitive, corners[0], corners[1], corners[2]);
    for (int k = 0; k < 3; k++) {
        corners[k] -= frame.camera_position;
    }
    vec3 placed[3];
    vec4 bounds;
    float margin;
    bool proposed = propose(frame, area, corners, placed, bounds, margin);
    covering = margin > 0.0 ? 0u : 1u;
    pixel_bounds = bounds * area.half_side + 0.5 * area.size.xyxy;
    if (!proposed) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    vec2 dilated[3];
    vec2 place = covering == 0u && coverage_dilated(placed[0], placed[1], placed[2], margin, bounds.zw - bounds.xy, dilated)
        ? dilated[corner]
        : coverage_rectangle(bounds, corner);
    gl_Position = vec4(place * (2.0 * area.half_side) / area.size, 0.5, 1.0);
}

// Compute shader of the host: traces a ray through the bricks for every pixel of a square, on the spot.
// Reads: geometry, bricks. Writes: the hit of every pixel.
// Set 0 is the host's. Geometry and structure have the sets after it.
#version 460
#include "contract/extensions.glsl"

#define GEOMETRY_SET 1
#define STRUCTURE_SET 2
#include "bricks/trace.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) buffer HitBuffer { Hit hits[]; };

// Pixels along a side of the square.
const uint SIDE = 32u;

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, uvec2(SIDE)))) {
        return;
    }
    vec3 origin = vec3(vec2(pixel) / float(SIDE), -1.0);
    Ray ray = Ray(origin, 0.0, vec3(0.0625, 0.03125, 1.0), 4.0, PRIMITIVE_NONE, 0u, 0.0, 0.0);
    TraceState state = trace_state_begin(ray);
    Hit hit;
    uint result = TRACE_PAUSED;
    for (uint round = 0u; round < 16u && result == TRACE_PAUSED; round++) {
        result = bricks_trace_closest(BricksRef(uvec2(0u)), ray, state, hit);
    }
    // While the bricks are not ready or the ray is still paused, no hit is written. The host then shows an
    // earlier picture.
    if (result == TRACE_HIT || result == TRACE_MISS) {
        hits[pixel.y * SIDE + pixel.x] = hit;
    }
}

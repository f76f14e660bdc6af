// What: the bounds of a geometry from those of its two parts; one invocation.
// Reads: the headers of both parts; what moves was measured just before (ads/geometry_bounds.comp), the bounds of the
// other are what its header states. Writes: bounds of the header of GEOMETRY_SET, unchanged where neither part has any;
// the same in both parts, as the bounds around them.
#version 460
#include "contract/extensions.glsl"

layout(local_size_x = 1) in;

#define GEOMETRY_WRITTEN
#include "ads/geometry.glsl"

layout(set = 1, binding = 0, scalar) buffer GeometryStaticBuffer {
    GeometryHeader geometry_static;
};
layout(set = 1, binding = 1, scalar) buffer GeometryMovingBuffer {
    GeometryHeader geometry_moving;
};

void main() {
    bool any_static = geometry_static.triangle_count > 0u;
    bool any_moving = geometry_moving.lower_keys[0] <= geometry_moving.upper_keys[0];
    if (any_static && any_moving) {
        geometry_header.lower = min(geometry_static.lower, geometry_moving.lower);
        geometry_header.upper = max(geometry_static.upper, geometry_moving.upper);
    } else if (any_static) {
        geometry_header.lower = geometry_static.lower;
        geometry_header.upper = geometry_static.upper;
    } else if (any_moving) {
        geometry_header.lower = geometry_moving.lower;
        geometry_header.upper = geometry_moving.upper;
    }
    geometry_header.around_lower = geometry_header.lower;
    geometry_header.around_upper = geometry_header.upper;
    geometry_static.around_lower = geometry_header.lower;
    geometry_static.around_upper = geometry_header.upper;
    geometry_moving.around_lower = geometry_header.lower;
    geometry_moving.around_upper = geometry_header.upper;
}

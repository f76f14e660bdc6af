// Bounds from their keys; one invocation.
// Reads: keys of the header of GEOMETRY_SET. Writes: its bounds; zeros where there is no triangle.
#version 460
#include "contract/extensions.glsl"

layout(local_size_x = 1) in;

#define GEOMETRY_WRITTEN
#include "ads/float_keys.glsl"
#include "ads/geometry.glsl"

void main() {
    bool any_corner = geometry_header.lower_keys[0] <= geometry_header.upper_keys[0];
    [[unroll]] for (int axis = 0; axis < 3; axis++) {
        geometry_header.lower[axis] = any_corner ? float_of(geometry_header.lower_keys[axis]) : 0.0;
        geometry_header.upper[axis] = any_corner ? float_of(geometry_header.upper_keys[axis]) : 0.0;
    }
    // For a part, ads/geometry_bounds_unite.comp follows.
    geometry_header.around_lower = geometry_header.lower;
    geometry_header.around_upper = geometry_header.upper;
}

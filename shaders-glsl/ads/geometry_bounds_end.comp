// Converts the keys of the bounds to bounds.
// Reads: keys in the header of GEOMETRY_SET. Writes: bounds in the header; zeros if there is no triangle.
// One invocation.
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
    // These are replaced by ads/geometry_bounds_unite.comp, which follows where the geometry is a part.
    geometry_header.around_lower = geometry_header.lower;
    geometry_header.around_upper = geometry_header.upper;
}

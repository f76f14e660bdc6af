// The bounds of a geometry from those of its parts; one invocation.
// Reads: copies of the headers of all parts; what moves was measured just before (ads/geometry_bounds.comp), the bounds of
// any other part are what its header states. Writes: bounds of the header of GEOMETRY_SET, unchanged where no part has any.
#version 460
#include "contract/extensions.glsl"

layout(local_size_x = 1) in;

#define GEOMETRY_WRITTEN
#include "ads/geometry.glsl"

layout(set = 1, binding = 0, scalar) readonly buffer GeometryPartsBuffer {
    GeometryHeader geometry_parts[];
};

void main() {
    bool any_part = false;
    vec3 lower = vec3(0.0);
    vec3 upper = vec3(0.0);
    for (uint part = 0u; part < uint(geometry_parts.length()); part++) {
        // The keys of a part that was not measured are equal.
        if (geometry_parts[part].triangle_count == 0u
            || geometry_parts[part].lower_keys[0] > geometry_parts[part].upper_keys[0]) {
            continue;
        }
        lower = any_part ? min(lower, geometry_parts[part].lower) : geometry_parts[part].lower;
        upper = any_part ? max(upper, geometry_parts[part].upper) : geometry_parts[part].upper;
        any_part = true;
    }
    if (any_part) {
        geometry_header.lower = lower;
        geometry_header.upper = upper;
    }
    geometry_header.around_lower = geometry_header.lower;
    geometry_header.around_upper = geometry_header.upper;
}

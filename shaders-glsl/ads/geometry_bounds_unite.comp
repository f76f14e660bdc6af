// Unites the bounds of the parts of a geometry.
// Reads: copies of the headers of all parts. The bounds of parts that move were computed just before
// (ads/geometry_bounds.comp), those of other parts are stated by their headers. Writes: bounds in the header
// of GEOMETRY_SET, unless no part has any.
// One invocation.
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
        // A part whose bounds were stated and not computed has equal keys. Keys are in
        // the wrong order if they were computed and no corner was finite.
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

// What: declares the structure complete, or says what was missing.
// Reads: header. Writes: header.status.
#version 460
#include "contract/extensions.glsl"
#include "primitive/header.glsl"
#include "ads/build_status.glsl"

layout(local_size_x = 1) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

void main() {
    bool lists_fit = PRIMITIVE_HEADER(primitive_built).demand <= PRIMITIVE_HEADER(primitive_built).capacity
        && PRIMITIVE_HEADER(primitive_built).near_demand <= PRIMITIVE_HEADER(primitive_built).near_capacity;
    bool large_fits = PRIMITIVE_HEADER(primitive_built).large_demand <= PRIMITIVE_HEADER(primitive_built).large_capacity;
    PRIMITIVE_HEADER(primitive_built).status = build_status(lists_fit && large_fits);
}

// What: declares the structure complete, or says what was missing.
// Reads: header. Writes: header.status.
#version 460
#include "contract/extensions.glsl"
#include "primitive/header.glsl"

layout(local_size_x = 1) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

void main() {
    bool fits = PRIMITIVE_HEADER(primitive_built).demand <= PRIMITIVE_HEADER(primitive_built).capacity
        && PRIMITIVE_HEADER(primitive_built).near_demand <= PRIMITIVE_HEADER(primitive_built).near_capacity;
    PRIMITIVE_HEADER(primitive_built).status = fits ? STATUS_COMPLETE : STATUS_OVERFLOW;
}

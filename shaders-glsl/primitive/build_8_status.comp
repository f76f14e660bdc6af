// Sets the status of the structure: complete if everything fitted.
// Reads: header, geometry. Writes: header.status.
// One invocation.
#version 460
#include "contract/extensions.glsl"
#include "primitive/header.glsl"
#include "ads/build_status.glsl"
#include "primitive/names.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = 1) in;

void main() {
    bool lists_fit = PRIMITIVE_HEADER(build.structure).demand <= PRIMITIVE_HEADER(build.structure).capacity
        && PRIMITIVE_HEADER(build.structure).near_demand <= PRIMITIVE_HEADER(build.structure).near_capacity;
    bool large_fits = PRIMITIVE_HEADER(build.structure).large_demand <=
        PRIMITIVE_HEADER(build.structure).large_capacity;
    PRIMITIVE_HEADER(build.structure).status = build_status(lists_fit && large_fits);
}

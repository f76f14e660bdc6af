// Sets the status of the structure: complete if the boxes fitted.
// Reads: header, geometry. Writes: header.status.
// One invocation.
#version 460
#include "contract/extensions.glsl"
#include "driver/header.glsl"
#include "ads/build_status.glsl"
#include "driver/names.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = 1) in;

void main() {
    bool fits = geometry_triangle_count() <= DRIVER_HEADER(build.structure).capacity;
    DRIVER_HEADER(build.structure).status = build_status(fits);
}

// Fills in the parts of a structure's header that follow from the eye and from the bounds of the geometry,
// which only the device may know. This is the first pass of every build.
// Reads: the geometry's header; of the structure's header what the host wrote: options, capacities, eye.
// Writes: the structure's header.
// One invocation.
#version 460
#include "contract/extensions.glsl"
#include "ads/geometry.glsl"
#include "structure/names.glsl"
#include "structure/from_bounds.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = 1) in;

void main() {
    STRUCTURE_NAME(from_bounds)(build.structure, geometry_header.lower, geometry_header.upper);
}

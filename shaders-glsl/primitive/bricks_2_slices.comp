// What: where slices begin and how thick they are, from how many triangles begin in each octave of depth.
// Reads: header.octaves. Writes: header.slice_first, header.slice_shift.
// Source: not in the paper, whose buckets are those of a tile.
#version 460
#include "contract/extensions.glsl"
#include "primitive/brick_accessors.glsl"

layout(local_size_x = PRIMITIVE_GROUP_SIZE) in;

layout(push_constant, scalar) uniform PrimitiveBuildConstants {
    PrimitiveRef primitive_built;
};

void main() {
    if (gl_GlobalInvocationID.x != 0u) {
        return;
    }
    uint triangles = 0u;
    for (uint octave = 0u; octave < PRIMITIVE_OCTAVES; octave++) {
        triangles += PRIMITIVE_HEADER(primitive_built).octaves[octave];
    }
    // As few octaves as hold all but one triangle in PRIMITIVE_OCTAVE_SHARE; what is nearer is in the first slice.
    uint octaves = PRIMITIVE_OCTAVES;
    uint nearer = PRIMITIVE_HEADER(primitive_built).octaves[PRIMITIVE_OCTAVES - 1u];
    while (octaves > 1u && nearer <= triangles / PRIMITIVE_OCTAVE_SHARE) {
        octaves--;
        nearer += PRIMITIVE_HEADER(primitive_built).octaves[octaves - 1u];
    }
    Slices slices = slices_over(PRIMITIVE_HEADER(primitive_built).reach, octaves, PRIMITIVE_HEADER(primitive_built).slices);
    PRIMITIVE_HEADER(primitive_built).slice_first = slices.first;
    PRIMITIVE_HEADER(primitive_built).slice_shift = slices.shift;
}

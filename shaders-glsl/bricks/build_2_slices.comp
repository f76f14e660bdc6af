// Begin and thickness of slices, from the number of triangles that begin in each octave of depth.
// Reads: header.octaves. Writes: header.slice_first, header.slice_shift.
// Source: not in the paper, whose buckets are those of a tile.
#version 460
#include "contract/extensions.glsl"
#include "bricks/accessors.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = BRICK_GROUP_SIZE) in;

void main() {
    if (gl_GlobalInvocationID.x != 0u) {
        return;
    }
    uint triangles = 0u;
    for (uint octave = 0u; octave < BRICK_OCTAVES; octave++) {
        triangles += BRICK_HEADER(build.structure).octaves[octave];
    }
    // As few octaves as hold all but one triangle in BRICK_OCTAVE_SHARE; nearer depths are in the first slice.
    uint octaves = BRICK_OCTAVES;
    uint nearer = BRICK_HEADER(build.structure).octaves[BRICK_OCTAVES - 1u];
    while (octaves > 1u && nearer <= triangles / BRICK_OCTAVE_SHARE) {
        octaves--;
        nearer += BRICK_HEADER(build.structure).octaves[octaves - 1u];
    }
    BrickSlices slices = brick_slices_over(BRICK_HEADER(build.structure).reach, octaves,
        BRICK_HEADER(build.structure).slices);
    BRICK_HEADER(build.structure).slice_first = slices.first;
    BRICK_HEADER(build.structure).slice_shift = slices.shift;
}

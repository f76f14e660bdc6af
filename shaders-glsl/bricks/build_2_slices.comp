// Computes where slices begin and how thick they are, from the number of triangles that begin in each octave
// of depth.
// Reads: header.octaves, header.reach, header.slices. Writes: header.slice_first, header.slice_shift.
// One invocation.
// Source: not in the paper, whose buckets are those of a tile.
#version 460
#include "contract/extensions.glsl"
#include "bricks/accessors.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    if (gl_GlobalInvocationID.x != 0u) {
        return;
    }
    uint triangles = 0u;
    for (uint octave = 0u; octave < BRICKS_OCTAVES; octave++) {
        triangles += BRICKS_HEADER(build.structure).octaves[octave];
    }
    // The slices cover as few octaves as possible, so that at most one triangle in BRICKS_OCTAVE_SHARE begins
    // nearer. Nearer depths are in the first slice.
    uint octaves = BRICKS_OCTAVES;
    uint nearer = BRICKS_HEADER(build.structure).octaves[BRICKS_OCTAVES - 1u];
    while (octaves > 1u && nearer <= triangles / BRICKS_OCTAVE_SHARE) {
        octaves--;
        nearer += BRICKS_HEADER(build.structure).octaves[octaves - 1u];
    }
    BricksSlices slices = bricks_slices_over(BRICKS_HEADER(build.structure).reach, octaves,
        BRICKS_HEADER(build.structure).slices);
    BRICKS_HEADER(build.structure).slice_first = slices.first;
    BRICKS_HEADER(build.structure).slice_shift = slices.shift;
}

// What: begin and thickness of slices, from the number of triangles that begin in each octave of depth.
// Reads: header.octaves. Writes: header.slice_first, header.slice_shift.
// Source: not in the paper, whose buckets are those of a tile.
#version 460
#include "contract/extensions.glsl"
#include "bricks/accessors.glsl"

layout(local_size_x = BRICK_GROUP_SIZE) in;

layout(push_constant, scalar) uniform BrickBuildConstants {
    BrickRef brick_built;
};

void main() {
    if (gl_GlobalInvocationID.x != 0u) {
        return;
    }
    uint triangles = 0u;
    for (uint octave = 0u; octave < BRICK_OCTAVES; octave++) {
        triangles += BRICK_HEADER(brick_built).octaves[octave];
    }
    // As few octaves as hold all but one triangle in BRICK_OCTAVE_SHARE; nearer depths are in the first slice.
    uint octaves = BRICK_OCTAVES;
    uint nearer = BRICK_HEADER(brick_built).octaves[BRICK_OCTAVES - 1u];
    while (octaves > 1u && nearer <= triangles / BRICK_OCTAVE_SHARE) {
        octaves--;
        nearer += BRICK_HEADER(brick_built).octaves[octaves - 1u];
    }
    BrickSlices slices = brick_slices_over(BRICK_HEADER(brick_built).reach, octaves, BRICK_HEADER(brick_built).slices);
    BRICK_HEADER(brick_built).slice_first = slices.first;
    BRICK_HEADER(brick_built).slice_shift = slices.shift;
}

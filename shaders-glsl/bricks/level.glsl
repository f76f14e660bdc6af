// Shared parts of passes that build one level of bricks: their constants, and the bricks or records that they
// visit. Workgroups are counted on the device, so an invocation goes on with every BRICKS_LEVEL_STRIDE-th.
// Reads: header. Writes: nothing.
#ifndef BRICKS_LEVEL_GLSL
#define BRICKS_LEVEL_GLSL

#include "bricks/accessors.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"

#define BRICKS_LEVEL_STRIDE (gl_NumWorkGroups.x * BUILD_GROUP_SIZE)

// Returns the first brick or record of the level for this invocation, and the end of the level.
uvec2 bricks_level_bricks() {
    return uvec2(BRICKS_HEADER(build.structure).brick_first[build.step] + gl_GlobalInvocationID.x,
        min(BRICKS_HEADER(build.structure).brick_first[build.step + 1u], BRICKS_HEADER(build.structure).brick_capacity));
}

uvec2 bricks_level_records() {
    return uvec2(BRICKS_HEADER(build.structure).record_first[build.step] + gl_GlobalInvocationID.x,
        min(BRICKS_HEADER(build.structure).record_first[build.step + 1u], BRICKS_HEADER(build.structure).record_capacity));
}

#endif

// What the passes that build one level of bricks share: which bricks or records of the level an invocation
// works on.
// Reads: header. Writes: nothing.
// The device counts the workgroups, up to BRICKS_GROUPS_MOST. So an invocation works on the brick or record
// of its own number and on every BRICKS_LEVEL_STRIDE-th after it.
#ifndef BRICKS_LEVEL_GLSL
#define BRICKS_LEVEL_GLSL

#include "bricks/accessors.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"

#define BRICKS_LEVEL_STRIDE (gl_NumWorkGroups.x * BUILD_GROUP_SIZE)

// Returns the first brick of the level for this invocation, and the end of the level's bricks.
uvec2 bricks_level_bricks() {
    return uvec2(BRICKS_HEADER(build.structure).brick_first[build.step] + gl_GlobalInvocationID.x,
        min(BRICKS_HEADER(build.structure).brick_first[build.step + 1u], BRICKS_HEADER(build.structure).brick_capacity));
}

// Returns the first record of the level for this invocation, and the end of the level's records.
uvec2 bricks_level_records() {
    return uvec2(BRICKS_HEADER(build.structure).record_first[build.step] + gl_GlobalInvocationID.x,
        min(BRICKS_HEADER(build.structure).record_first[build.step + 1u], BRICKS_HEADER(build.structure).record_capacity));
}

#endif

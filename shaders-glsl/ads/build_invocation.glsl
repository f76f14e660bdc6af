// Numbers the invocations of a build pass.
// Reads, writes: nothing.
#ifndef ADS_BUILD_INVOCATION_GLSL
#define ADS_BUILD_INVOCATION_GLSL

#include "ads/constants.glsl"

// Returns the number of this invocation. Workgroups have BUILD_GROUP_SIZE invocations and fill two
// dimensions.
uint build_invocation() {
    return gl_GlobalInvocationID.y * gl_NumWorkGroups.x * BUILD_GROUP_SIZE + gl_GlobalInvocationID.x;
}

#endif

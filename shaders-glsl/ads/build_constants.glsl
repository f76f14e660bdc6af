// The push constants of every build pass.
// Reads: push constants. Writes: nothing.
// The including file first includes the structure's accessors and names, which define StructureRef.
#ifndef ADS_BUILD_CONSTANTS_GLSL
#define ADS_BUILD_CONSTANTS_GLSL

#include "ads/constants.glsl"

// The structure that a build pass works on, and a parameter of the pass. 12 bytes.
layout(push_constant, scalar) uniform BuildConstants {
    StructureRef structure;   // the device address of the header, low word first; zero with descriptors
    uint step;                // a number whose meaning depends on the pass, such as the digit of a sort
} build;

#endif

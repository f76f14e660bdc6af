// The header of the driver's tree over boxes of triangles.
// Reads, writes: nothing.
// Source: docs/systems/driver-rt.md.
#ifndef DRIVER_TYPES_GLSL
#define DRIVER_TYPES_GLSL

#include "contract/types.glsl"
#include "driver/constants.glsl"

// State and sizes of the structure, and where its boxes and its tree are. Shared, 88 bytes.
struct DriverHeader {
    uint status;          // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint capacity;        // boxes that the pool holds
    uint corrupted;       // invalid indices met; always 0, since the tree holds no indices of the project's
    float reach;          // half the longest side of the bounds, metres; more if the eye is far away
    float rounding;       // bound of the shift by rounding between a triangle and a ray, metres
    // units of boxes per metre: the power of two that scales the reach to a number from 1 to 2
    float scale;
    vec3 eye;             // the eye, metres relative to the frame origin
    vec3 centre;          // middle of the bounds of the geometry, metres relative to the frame origin
    vec3 lower;           // lower corner of the bounds relative to the centre, widened by rounding, metres
    vec3 upper;           // upper corner in the same sense
    uvec2 tree;           // device address of the driver's tree
    uvec2 boxes_address;  // device address of the boxes; zero with descriptors
};

#endif

// The header of a tree of the driver over boxes of triangles.
// Reads, writes: nothing.
// Source: docs/systems/driver-rt.md.
#ifndef DRIVER_TYPES_GLSL
#define DRIVER_TYPES_GLSL

#include "contract/types.glsl"
#include "driver/constants.glsl"

// State and sizes of the tree, and where its boxes are. Shared, 88 bytes.
struct DriverHeader {
    uint status;          // STATUS_*; without STATUS_COMPLETE traces answer "not ready"
    uint capacity;        // boxes the pool holds
    uint corrupted;       // always 0: no index of the project's is in the tree
    float reach;          // metres: half the longest side of the bounds; more where the eye is far away
    float rounding;       // metres: bound of how far rounding moves a triangle against a ray
    float scale;          // units of boxes per metre: a power of two, by which the reach is from 1 to 2
    vec3 eye;             // metres relative to the frame origin
    vec3 centre;          // metres relative to the frame origin: centre of the bounds of the geometry
    vec3 lower;           // lower corner of the geometry relative to the centre, metres
    vec3 upper;           // upper corner of the geometry relative to the centre, metres
    uvec2 tree;           // device address of the driver's tree
    uvec2 boxes_address;  // device address of the boxes; zero with descriptors
};

#endif

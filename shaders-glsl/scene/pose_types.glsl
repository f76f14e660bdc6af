// The records of the pass that poses draws on the device. Scalar block layout.
// Reads: nothing. Writes: nothing. Source: docs/motion.md, "On the device".
#ifndef SCENE_POSE_TYPES_GLSL
#define SCENE_POSE_TYPES_GLSL

#include "scene/constants.glsl"

// Vertices of one workgroup. Shared, 8 bytes.
struct PoseGroup {
    uint draw;                  // index into the pose draws
    uint first_vertex;          // of the draw; as many as a workgroup has threads, or what is left of the draw
};

// Draw that moves: the source and the destination of its vertices. Words count from the start of the named
// table; ATTRIBUTE_NONE means absent. Shared, 44 bytes.
struct PoseDraw {
    uint draw;                  // index into the draw shadings
    uint first_vertex;          // global vertex index of its first vertex
    uint vertex_count;          // vertices of the draw
    uint rest_positions;        // rest positions, 3 words a vertex, metres, relative to a pivot
    uint rest_normals;          // rest attributes, 3 words a vertex
    uint rest_tangents;         // rest attributes, 4 words a vertex: xyz, w = +1 or -1
    uint normals;               // posed attributes, 3 words a vertex
    uint tangents;              // posed attributes, 4 words a vertex
    uint skin;                  // skins: of each vertex its joints, then as many weights; ATTRIBUTE_NONE: no joints
    uint joints_per_vertex;     // joints and weights of a vertex
    uint first_joint;           // joint 0 of its skin in the joint matrices
};

// An affine map. Shared, 48 bytes.
struct PoseMatrix {
    vec3 x;                     // where x goes
    vec3 y;                     // where y goes
    vec3 z;                     // where z goes
    vec3 translation;           // metres, added last
};

// Placement of a draw in this frame. Shared, 96 bytes.
struct PosePlacement {
    PoseMatrix place;           // from the pivot to the frame origin; with joints they turn, and this is the translation alone
    vec3 normal_x;              // the map of normals, scaled so that its largest element is about 1; unused with joints
    vec3 normal_y;              // its second column
    vec3 normal_z;              // its third column
    uint flags;                 // DRAW_MIRRORED where the map mirrors
    uint first_target;          // in the shown targets
    uint target_count;          // morph targets that count in this frame
};

// A morph target with its weight. Shared, 16 bytes.
struct PoseTarget {
    uint positions;             // displacements, 3 words a vertex, metres
    uint normals;               // displacements, 3 words a vertex
    uint tangents;              // displacements, 3 words a vertex
    float weight;               // not 0
};

// Sum of the powers of the lights before a light, and its own power, by luminance. Shared, 8 bytes.
struct PoseLightPower {
    float near;                 // W, of point and spot lights
    float far;                  // W/m^2, of directional lights
};

#endif

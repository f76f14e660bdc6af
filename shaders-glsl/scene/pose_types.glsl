// The records of the passes that pose draws on the device, in scalar block layout.
// Reads, writes: nothing.
// Source: docs/motion.md, "On the device".
#ifndef SCENE_POSE_TYPES_GLSL
#define SCENE_POSE_TYPES_GLSL

#include "scene/constants.glsl"

// Vertices that one workgroup poses: as many as it has threads, or what is left of the draw. Shared, 8 bytes.
struct PoseGroup {
    uint draw;                  // index into the pose draws
    uint first_vertex;          // number of the group's first vertex within the draw
};

// A draw that moves: where its vertices are read and written. A word is counted from the beginning of the
// table that the member's comment names; ATTRIBUTE_NONE stands for none. Shared, 44 bytes.
struct PoseDraw {
    uint draw;                  // index into the draw shadings
    uint first_vertex;          // global vertex index of its first vertex
    uint vertex_count;          // vertices of the draw
    uint rest_positions;        // word of the rest positions, 3 words a vertex, metres relative to a pivot
    uint rest_normals;          // word of the rest normals in the rest attributes, 3 words a vertex
    uint rest_tangents;         // word of the rest tangents among these, 4 words a vertex: xyz, w = +1 or -1
    uint normals;               // word of the normals in the posed attributes, 3 words a vertex
    uint tangents;              // word of the tangents in the posed attributes, 4 words a vertex
    // word in the skins: for each vertex its joints, then as many weights; ATTRIBUTE_NONE: the draw has no
    // joints
    uint skin;
    uint joints_per_vertex;     // joints of a vertex, and weights
    uint first_joint;           // number of the skin's joint 0 in the joint matrices
};

// An affine map. Shared, 48 bytes.
struct PoseMatrix {
    vec3 x;                     // image of the x axis
    vec3 y;                     // image of the y axis
    vec3 z;                     // image of the z axis
    vec3 translation;           // metres, added after the linear part
};

// The placement of a draw in this frame. Shared, 96 bytes.
struct PosePlacement {
    // map from the pivot to the frame origin; with joints these turn the draw, and this is the translation
    // alone
    PoseMatrix place;
    // first column of the map of normals, scaled so that its largest element is about 1; unused with joints
    vec3 normal_x;
    vec3 normal_y;              // second column of that map
    vec3 normal_z;              // third column of that map
    uint flags;                 // DRAW_MIRRORED if the map mirrors
    uint first_target;          // number of the first morph target in the shown targets
    uint target_count;          // morph targets whose weight is not 0 in this frame
};

// A morph target with its weight. Words are in the displacements. Shared, 16 bytes.
struct PoseTarget {
    // word of the displacements of positions, 3 words a vertex, metres; or ATTRIBUTE_NONE
    uint positions;
    // word of the displacements of normals, 3 words a vertex; or ATTRIBUTE_NONE
    uint normals;
    // word of the displacements of tangents, 3 words a vertex; or ATTRIBUTE_NONE
    uint tangents;
    float weight;               // not 0
};

// Sum of the powers of the lights up to and including a light, by luminance. Shared, 8 bytes.
struct PoseLightPower {
    float near;                 // W, of point and spot lights
    float far;                  // W/m^2, of directional lights
};

#endif

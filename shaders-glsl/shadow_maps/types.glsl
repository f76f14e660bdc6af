// The records of shadow maps. Scalar block layout.
// Reads, writes: nothing. Source: docs/shadow-maps.md.
#ifndef SHADOW_MAPS_TYPES_GLSL
#define SHADOW_MAPS_TYPES_GLSL

// Values that all maps share. Shared, 32 bytes.
struct ShadowMapsHeader {
    uint status;          // STATUS_COMPLETE with the stamp of the triangles that are drawn; 0: nothing is built
    uint resolution;      // texels along a side of a view
    uint light_count;     // lights without extent
    uint view_count;      // views of all lights and points
    float bias;           // of the depth that a plane gains within half a texel, the share that is added to each texel
    uint emitter_count;   // emitting triangles
    uint point_count;     // points on each of them; 0: they have no maps
    uint first_point;     // first view of the first point; each has SHADOW_MAPS_CUBE_VIEWS
};

// Views of a light without extent. Shared, 8 bytes.
struct ShadowMapsLight {
    uint first_view;      // its first view
    uint view_count;      // 1, or SHADOW_MAPS_CUBE_VIEWS
};

// View: one square of texels. A point p is at (x, y, z) = (right, up, forward) . (p - origin), and on the map
// at (x, y), in perspective at (x/z, y/z), which runs from -1 to 1. Depth is z, metres. Shared, 60 bytes.
struct ShadowMapsView {
    vec3 origin;          // the light; of a parallel view, the middle of its front side; metres relative to the frame origin
    vec3 right;           // 1/metre in a parallel view
    vec3 up;              // as `right`
    vec3 forward;         // unit
    uint parallel;        // 1: of a light far away
    float rounding;       // metres by which computed depths may differ from true ones
    uint excluded;        // triangle that a point is on, which occludes nothing; PRIMITIVE_NONE: of a light without extent
};

#endif

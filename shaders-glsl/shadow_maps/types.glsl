// The records of shadow maps, in scalar block layout.
// Reads, writes: nothing.
// Source: docs/shadow-maps.md.
#ifndef SHADOW_MAPS_TYPES_GLSL
#define SHADOW_MAPS_TYPES_GLSL

// Values that all maps share. Shared, 32 bytes.
struct ShadowMapsHeader {
    uint status;          // STATUS_COMPLETE with the stamp of the triangles drawn; 0: nothing is built
    uint resolution;      // texels along a side of a view
    uint light_count;     // lights without extent
    uint view_count;      // views of all lights and points
    // share, added to each texel, of the depth that a plane gains from the texel's centre to its corners
    float bias;
    uint emitter_count;   // emitting triangles
    uint point_count;     // points on each emitting triangle; 0: these have no maps
    uint first_point;     // first view of the first point; each point has SHADOW_MAPS_CUBE_VIEWS views
};

// Views of a light without extent. Shared, 8 bytes.
struct ShadowMapsLight {
    uint first_view;      // number of the first of its views
    uint view_count;      // 1, or SHADOW_MAPS_CUBE_VIEWS
};

// A view: one square of texels. A point p has the coordinates (x, y, z) = (right, up, forward) . (p - origin)
// in the view. On the map it is at (x, y) in a parallel view, at (x/z, y/z) in a perspective one; the map
// spans -1 to 1. Depth is z, metres. Shared, 60 bytes.
struct ShadowMapsView {
    // metres relative to the frame origin: position of the light; in a parallel view the middle of its front
    // side
    vec3 origin;
    // axis of the map's columns, divided by half the map's width; 1/metre in a parallel view
    vec3 right;
    vec3 up;              // axis of the map's rows, in the same form
    vec3 forward;         // axis of depth, unit
    uint parallel;        // 1: the view is parallel, of a light far away
    float rounding;       // metres: largest difference between computed and true depths
    // triangle on which the view's point lies, which occludes nothing; PRIMITIVE_NONE: the view is of a light
    // without extent
    uint excluded;
};

#endif

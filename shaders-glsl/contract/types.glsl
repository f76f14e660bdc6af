// The types that structures, tracer and integrators exchange. Scalar block layout, checked against
// the Rust side by reflection.
#ifndef CONTRACT_TYPES_GLSL
#define CONTRACT_TYPES_GLSL

#include "contract/constants.glsl"

// A ray in metres relative to the frame origin. 48 bytes.
// Hits count for t_min < t < t_max, t in units of |direction|.
struct Ray {
    vec3 origin;
    float t_min;
    vec3 direction;           // need not be unit, must be finite and not zero
    float t_max;              // may be +infinity
    uint exclude_primitive;   // never hit; PRIMITIVE_NONE excludes nothing
    uint flags;               // 0: kept for what a ray may ask beyond this, none so far
    float cone_width;         // metres at the origin
    float cone_spread;        // radians, growth of the width per metre
};

// What a ray met. 16 bytes. A miss has primitive PRIMITIVE_NONE and t = t_max.
// a and b belong to the structure: barycentrics of vertices 1 and 2 where hits are primitives.
struct Hit {
    float t;
    uint primitive;           // global triangle id
    float a;
    float b;
};

// Where a traversal stands, so that it can pause and go on. 64 bytes. Zeroed (trace_state_begin)
// for a fresh ray; `cursor` belongs to the structure.
struct TraceState {
    Hit best;
    uint cursor[8];
    uint cells;               // cells stepped so far
    uint entries;             // list entries read so far
    uint tests;               // primitive tests so far
    uint rounds;              // dispatches so far
};

// What a ray has spent. 16 bytes.
struct RayWork {
    uint cells;               // cells stepped
    uint entries;             // list entries read
    uint tests;               // primitive tests
    uint rounds;              // dispatches
};

// What is shaded. 128 bytes. Metres relative to the frame origin, linear Rec. 709, W/(sr m^2).
struct Surface {
    vec3 position;
    float position_error;     // metres: bound of |computed - true| along each axis
    vec3 geometric_normal;    // unit, faces the ray
    uint primitive;           // global triangle id or PRIMITIVE_NONE
    vec3 normal;              // unit shading normal, on the side of geometric_normal
    uint valid;               // SURFACE_* bits; 0 is a miss
    vec3 base_color;
    float metallic;
    vec3 emission;
    float roughness;          // perceptual
    float transmission;
    float ior;
    float opacity;            // 1 unless the material blends
    float thickness;          // metres; 0 is a thin wall
    vec3 attenuation_color;
    float attenuation_distance;
    float specular;
    uint side;                // 1: the ray came from the front (counter-clockwise side)
    float t;                  // of the hit
    uint material;            // index, or PRIMITIVE_NONE
};

// One run of triangles of one instance. Global triangle id = first_triangle + local index.
struct Draw {
    uint first_triangle;
    uint triangle_count;
    uint instance;
    uint flags;               // DRAW_*
    uint first_index;         // of its first triangle, in the indices handed in; read where they are gathered
    int base_vertex;          // added to its indices where they are gathered
};

#endif

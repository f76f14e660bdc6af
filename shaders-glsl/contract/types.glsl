// The types that structures, tracer and integrators exchange. Scalar block layout, checked against
// the Rust side by reflection.
#ifndef CONTRACT_TYPES_GLSL
#define CONTRACT_TYPES_GLSL

#include "contract/constants.glsl"

// A ray in metres relative to the frame origin. Shared, 48 bytes.
// Hits count for t_min < t < t_max, t in units of |direction|.
struct Ray {
    vec3 origin;              // metres relative to the frame origin
    float t_min;              // hits at or before this t do not count
    vec3 direction;           // need not be unit; finite and not zero
    float t_max;              // may be infinite; negative: the ray is inactive
    uint exclude_primitive;   // never hit; PRIMITIVE_NONE excludes nothing
    uint flags;               // RAY_* bits
    float cone_width;         // width of the ray cone at the origin, metres
    float cone_spread;        // growth of the width per metre, radians
};

// Hit of a ray. Shared, 16 bytes. A miss has primitive PRIMITIVE_NONE and t = t_max.
// a and b belong to the structure: barycentrics of vertices 1 and 2 where hits are primitives.
struct Hit {
    float t;                  // in units of the ray direction's length
    uint primitive;           // global triangle id; PRIMITIVE_UNKNOWN for a fragment that does not keep it
    float a;                  // the structure's; weight of vertex 1 where hits are primitives
    // the structure's; weight of vertex 2 where hits are primitives, and the bits HIT_STORED where a stored fragment has its
    // triangle's id, HIT_EARLIER or a little less where it lies in a part that was traced before
    float b;
};

// The position of a traversal, so that it can pause and resume. Shared, 64 bytes. Zeroed (trace_state_begin)
// for a fresh ray; `cursor` belongs to the structure.
struct TraceState {
    Hit best;                 // best hit so far
    uint cursor[8];           // the structure's
    uint cells;               // cells visited so far
    uint entries;             // list entries read so far
    uint tests;               // primitive tests so far
    // where work is counted: bit 0 is set where a cell was visited and nothing of what it holds has been read yet, the bits
    // above are one more than the view entered last
    uint visit;
};

// The work of a ray. Shared, 24 bytes.
struct RayWork {
    uint cells;               // cells visited
    uint entries;             // list entries read
    uint tests;               // primitives tested
    uint rounds;              // dispatches the ray took part in
    uint views;               // views entered, each once until another is; the near region is none
    uint searched;            // of the cells visited, those in which a list entry was read or cells of its own were searched
};

// A surface to be shaded. Shared, 128 bytes. Metres relative to the frame origin, linear Rec. 709, W/(sr m^2).
struct Surface {
    vec3 position;            // where the surface is
    float position_error;     // metres: bound of `|computed - true|` along each axis
    vec3 geometric_normal;    // unit, faces the ray
    uint primitive;           // global triangle id, PRIMITIVE_UNKNOWN or PRIMITIVE_NONE
    vec3 normal;              // unit shading normal, on the side of geometric_normal
    uint valid;               // SURFACE_* bits of what the structure knows; 0 is a miss
    vec3 base_color;          // linear
    float metallic;           // in [0, 1]
    vec3 emission;            // radiance
    float roughness;          // perceptual, in [0, 1]
    float transmission;       // in [0, 1]
    float ior;                // index of refraction
    float opacity;            // in [0, 1]; 1 unless the material blends
    float thickness;          // metres; 0 is a thin wall
    vec3 attenuation_color;   // colour of white light after attenuation_distance
    float attenuation_distance; // metres
    float specular;           // strength of dielectric reflection
    uint side;                // 1: the ray came from the front (counter-clockwise side)
    float t;                  // of the hit, in units of the ray direction's length
    uint material;            // index of the material, or PRIMITIVE_NONE
};

// One run of triangles of one instance. Shared, 24 bytes. Global triangle id = first_triangle + local index.
struct Draw {
    uint first_triangle;      // global id of the first triangle
    uint triangle_count;      // number of triangles
    uint instance;            // index of the instance
    uint flags;               // DRAW_* bits
    uint first_index;         // index of its first triangle's first vertex in the indices handed in; read where they are gathered
    int base_vertex;          // added to its indices where they are gathered
};

#endif

// The records that structures, the tracer and integrators exchange.
// Their layout is scalar. Rust has the same records, generated from this file; tests compare both with the
// compiled modules.
#ifndef CONTRACT_TYPES_GLSL
#define CONTRACT_TYPES_GLSL

#include "contract/constants.glsl"

// A ray. Hits count for t_min < t < t_max, where t is in units of the direction's length. Shared, 48 bytes.
struct Ray {
    vec3 origin;              // metres relative to the frame origin
    float t_min;              // hits at or before this t do not count
    vec3 direction;           // need not be unit; finite and not zero
    float t_max;              // may be infinite; a ray with a negative one is inactive
    uint exclude_primitive;   // id of a triangle that the ray never hits; PRIMITIVE_NONE excludes nothing
    uint flags;               // RAY_* bits, and the light of a shadow ray from bit RAY_LIGHT_SHIFT on
    float cone_width;         // width of the ray cone at the origin, metres
    float cone_spread;        // growth of the ray cone's width per metre, radians
};

// The hit of a ray. A miss has the primitive PRIMITIVE_NONE and t = t_max. Shared, 16 bytes.
struct Hit {
    float t;                  // in units of the ray direction's length
    // id of the triangle; PRIMITIVE_UNKNOWN for a fragment that does not keep its triangle
    uint primitive;
    // weight of vertex 1 where a triangle is hit; otherwise its meaning is the structure's
    float a;
    // weight of vertex 2 where a triangle is hit; otherwise its meaning is the structure's, or its bits are a
    // mark: HIT_STORED where a stored fragment has its triangle's id, HIT_EARLIER or a little less where the
    // fragment lies in a part that was traced before (contract/stored_hit.glsl)
    float b;
};

// The state of a traversal, with which a ray pauses and resumes. trace_state_begin gives that of a ray that
// has not been traced yet. Shared, 64 bytes.
struct TraceState {
    Hit best;                 // best hit so far
    uint cursor[8];           // the place of the traversal, in a form of the structure's own
    uint cells;               // cells visited so far
    uint entries;             // list entries read so far, or nodes of a tree
    uint tests;               // triangles tested so far
    // for the counts of RayWork: bit 0 is set if a cell was visited and nothing in it has been read yet; the
    // bits above hold the number of the view entered last plus one, or 0 before the first
    uint visit;
};

// The work of one ray. Shared, 24 bytes.
struct RayWork {
    uint cells;               // cells visited
    uint entries;             // list entries read, or nodes of a tree
    uint tests;               // primitives tested
    uint rounds;              // dispatches that the ray took part in
    // views entered; a view counts again only after another one was entered, and the near region is none
    uint views;
    // visited cells of which a list entry was read, or in which cells of their own were searched
    uint searched;
};

// A surface to be shaded. Positions are in metres relative to the frame origin, colours are linear Rec. 709,
// radiance is in W/(sr m^2). Shared, 128 bytes.
struct Surface {
    vec3 position;            // the point of the surface that is shaded
    float position_error;     // metres: bound of `|computed - true|` along each axis
    vec3 geometric_normal;    // unit normal of the triangle, on the side that the ray comes from
    uint primitive;           // global triangle id, PRIMITIVE_UNKNOWN or PRIMITIVE_NONE
    vec3 normal;              // unit shading normal, on the side of geometric_normal
    uint valid;               // SURFACE_* bits of the fields that the structure knows; 0 for a miss
    vec3 base_color;          // linear colour
    float metallic;           // in [0, 1]
    vec3 emission;            // emitted radiance
    float roughness;          // perceptual roughness, in [0, 1]
    float transmission;       // in [0, 1]
    float ior;                // index of refraction
    float opacity;            // in [0, 1]; 1 unless the material blends
    float thickness;          // metres; 0 is a thin wall
    vec3 attenuation_color;   // colour that white light has after attenuation_distance
    float attenuation_distance; // metres
    float specular;           // strength of dielectric reflection, in [0, 1]
    // 1 if the ray came from the front of the mesh, its counter-clockwise side; else 0
    uint side;
    float t;                  // t of the hit, in units of the ray direction's length
    uint material;            // index of the material, or PRIMITIVE_NONE
};

// A run of consecutive triangles that belong to one instance. A triangle's id is first_triangle plus its
// number in the run. Shared, 24 bytes.
struct Draw {
    uint first_triangle;      // id of the first triangle
    uint triangle_count;      // number of triangles
    uint instance;            // index of the instance
    uint flags;               // DRAW_* bits
    // place of the first triangle's first vertex in the index buffer handed in; read by the pass that gathers
    // indices
    uint first_index;
    int base_vertex;          // number added to each index by the pass that gathers indices
};

#endif

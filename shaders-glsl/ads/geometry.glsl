// The geometry: posed triangles, from which all structures are built.
// Reads: header, positions, indices and draws of GEOMETRY_SET. Writes: nothing, except the header if
// GEOMETRY_WRITTEN is defined, and the indices if GEOMETRY_GATHERED is.
// Positions are metres relative to the frame origin. They are read where the host stores them, at any offset
// and stride in words. Indices are absolute u32; the host handed them in so, or ads/geometry_gather.comp made
// them.
// A geometry may be divided into parts over the same positions. A triangle then has an id, which is unique in
// the whole geometry, and a number in its part. Numbers begin at 0 and are in the order of ids.
#ifndef ADS_GEOMETRY_GLSL
#define ADS_GEOMETRY_GLSL

#include "contract/types.glsl"

#ifndef GEOMETRY_SET
#define GEOMETRY_SET 0
#endif

// Counts and bounds of a geometry or of a part, and where its positions and indices lie. Shared, 112 bytes.
struct GeometryHeader {
    uint vertex_count;   // vertices
    uint triangle_count; // triangles
    uint draw_count;     // draws
    // triangles that the last check found to be outside the bounds, to have an invalid vertex, or to be
    // beyond the maximum number
    uint outside;
    vec3 lower;          // lower corner of all positions, metres
    vec3 upper;          // upper corner of all positions, metres
    uint position_word;  // word of the first position in its binding
    uint position_words; // words from one position to the next
    uint index_word;     // word of the first index in its binding
    // lower corner while it is computed, as integers in the order of the floats (ads/float_keys.glsl)
    uint lower_keys[3];
    uint upper_keys[3];  // upper corner while it is computed, in the same form
    uint first_id;       // for a part that is one run of triangles: id of its first triangle; else 0
    uint run_count;      // for a part that is several runs of triangles: number of runs; else 0
    // for a part: lower corner of the whole geometry, from all of which rays may start; else the same as
    // `lower`
    vec3 around_lower;
    vec3 around_upper;   // upper corner in the same sense
    // value that tells these triangles from all others, in the bits of a status above STATUS_FLAGS; while
    // counted or gathered triangles cannot be read yet it is 0 or has the bit GEOMETRY_NOT_GATHERED
    uint stamp;
};

#ifdef GEOMETRY_WRITTEN
#define GEOMETRY_HEADER_ACCESS
#else
#define GEOMETRY_HEADER_ACCESS readonly
#endif
layout(set = GEOMETRY_SET, binding = 0, scalar) GEOMETRY_HEADER_ACCESS buffer GeometryHeaderBuffer {
    GeometryHeader geometry_header;
    // Runs of a part that has several, in order. x: number of the run's first triangle in the part, y: id of
    // that triangle.
    uvec2 geometry_runs[];
};
#ifdef GEOMETRY_GATHERED
#define GEOMETRY_INDEX_ACCESS
#else
#define GEOMETRY_INDEX_ACCESS readonly
#endif
layout(set = GEOMETRY_SET, binding = 1, scalar) readonly buffer GeometryPositionBuffer {
    float geometry_positions[];
};
layout(set = GEOMETRY_SET, binding = 2, scalar) GEOMETRY_INDEX_ACCESS buffer GeometryIndexBuffer {
    uint geometry_indices[];
};
layout(set = GEOMETRY_SET, binding = 3, scalar) readonly buffer GeometryDrawBuffer {
    Draw geometry_draws[];
};

uint geometry_triangle_count() {
    return geometry_header.triangle_count;
}

// True if no triangle is outside the bounds or invalid. Otherwise no build may be complete, since pools would
// not represent all triangles.
bool geometry_is_sound() {
    return geometry_header.outside == 0u;
}

// True if a status is that of a complete build of the triangles that are bound.
bool geometry_is_built(uint status) {
    return (status & STATUS_COMPLETE) != 0u && (status & ~STATUS_FLAGS) == geometry_header.stamp;
}

// Returns the posed position of a vertex; the origin if there is no such vertex.
vec3 geometry_position(uint vertex) {
    if (vertex >= geometry_header.vertex_count) {
        return vec3(0.0);
    }
    uint word = geometry_header.position_word + geometry_header.position_words * vertex;
    return vec3(geometry_positions[word], geometry_positions[word + 1u], geometry_positions[word + 2u]);
}

// Returns the three vertex indices of a triangle; zeros if there is no such triangle.
uvec3 geometry_triangle(uint primitive) {
    if (primitive >= geometry_header.triangle_count) {
        return uvec3(0u);
    }
    uint first = geometry_header.index_word + 3u * primitive;
    return uvec3(geometry_indices[first], geometry_indices[first + 1u], geometry_indices[first + 2u]);
}

// Returns the posed positions of three vertices.
void geometry_corners(uvec3 vertices, out vec3 a, out vec3 b, out vec3 c) {
    a = geometry_position(vertices.x);
    b = geometry_position(vertices.y);
    c = geometry_position(vertices.z);
}

// Returns the three posed corners of a triangle.
void geometry_vertices(uint primitive, out vec3 a, out vec3 b, out vec3 c) {
    geometry_corners(geometry_triangle(primitive), a, b, c);
}

// Returns the id of a triangle, given its number. O(log runs).
uint geometry_id(uint primitive) {
    uint end = geometry_header.run_count;
    if (end == 0u) {
        return geometry_header.first_id + primitive;
    }
    uint run = 0u;
    while (end > run + 1u) {
        uint middle = run + (end - run) / 2u;
        if (geometry_runs[middle].x > primitive) end = middle;
        else run = middle;
    }
    uvec2 found = geometry_runs[run];
    return found.y + (primitive - found.x);
}

// Returns the id of what a hit or a candidate names: a triangle's number, PRIMITIVE_NONE or
// PRIMITIVE_UNKNOWN, of which the latter two stay unchanged.
uint geometry_id_of(uint primitive) {
    return primitive < PRIMITIVE_UNKNOWN ? geometry_id(primitive) : primitive;
}

// Returns the rank of an id in the bound part: the number of triangles of the part that have lower ids. The
// rank of an id of this part is the triangle's number. For an id of another part it separates the triangles
// with lower ids from those with higher ids. O(log runs).
uint geometry_rank(uint id) {
    uint count = geometry_header.triangle_count;
    uint end = geometry_header.run_count;
    uvec2 found = uvec2(0u, geometry_header.first_id);
    if (end > 0u) {
        uint run = 0u;
        while (end > run + 1u) {
            uint middle = run + (end - run) / 2u;
            if (geometry_runs[middle].y > id) end = middle;
            else run = middle;
        }
        found = geometry_runs[run];
        count = end < geometry_header.run_count ? geometry_runs[end].x : count;
    }
    return id < found.y ? 0u : found.x + min(id - found.y, count - found.x);
}

// Returns the number of the triangle with an id; PRIMITIVE_NONE if the bound part does not have the triangle.
// O(log runs).
uint geometry_number(uint id) {
    uint rank = geometry_rank(id);
    return rank < geometry_header.triangle_count && geometry_id(rank) == id ? rank : PRIMITIVE_NONE;
}

// Returns the draw of the triangle with an id; 0 if there is none. Draws are in the order of their triangles.
// O(log draws).
uint geometry_draw_of_id(uint id) {
    uint draw = 0u;
    uint end = geometry_header.draw_count;
    while (end > draw + 1u) {
        uint middle = draw + (end - draw) / 2u;
        if (geometry_draws[middle].first_triangle > id) end = middle;
        else draw = middle;
    }
    return draw;
}

// Returns the draw of a triangle, given the triangle's number.
uint geometry_draw(uint primitive) {
    return geometry_draw_of_id(geometry_id(primitive));
}

#endif

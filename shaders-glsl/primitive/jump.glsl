// The published march: each step goes from where a ray leaves a tile to the tile half a pixel beyond,
// measured along the axis on which the ray is faster.
// Reads: header. Writes: nothing.
// Source: DIRT section 4.2.1 and the authors' program. Tiles that the ray crosses within the half pixel are
// skipped.
#ifndef PRIMITIVE_JUMP_GLSL
#define PRIMITIVE_JUMP_GLSL

#include "ads/march_skip.glsl"
#include "primitive/header.glsl"

// Returns half a pixel in x/z. A face is 2 wide.
float primitive_half_pixel(PrimitiveRef s) {
    return 1.0 / float(PRIMITIVE_HEADER(s).tiles * PRIMITIVE_HEADER(s).tile);
}

// Steps to the tile half a pixel beyond the exit from a tile or a block of tiles, or to the tile in which the
// segment ends; returns false behind that tile. A face takes at most two jumps per pixel and one step per
// tile.
bool primitive_jump(PrimitiveRef s, inout CellMarch m, MarchSkip skip) {
    m.neighbours = 0u;
    if (!skip.step_x && !skip.step_y) {
        return false;
    }
    precise vec2 ahead = m.direction.xy * m.origin.z;
    precise vec2 behind = m.origin.xy * m.direction.z;
    vec2 heading = abs(ahead - behind);
    int axis = heading.x >= heading.y ? 0 : 1;
    vec3 leaves = m.origin + skip.t_out * m.direction;
    int way = m.step_direction[axis];
    float landing = leaves[axis] / leaves.z + float(way) * primitive_half_pixel(s);
    float error;
    float t = march_crossing(landing, m.origin[axis], m.direction[axis], m.origin.z, m.direction.z, way, error);
    // If rounding loses the half pixel, the exact march takes this step, so that the march of every ray ends.
    if (!(t > skip.t_out)) {
        bool more = march_take_skip(m, skip);
        m.neighbours = 0u;
        return more;
    }
    // The paper marches up to the projection of the ray's end, whose tile is the last.
    if (!(t < m.t_end)) {
        if (!(m.t_in < m.t_end) || m.t_end > 3.0e38) {
            return false;
        }
        t = m.t_end;
        error = FLOAT_ROUNDING * 16.0 * abs(t);
    }
    ivec2 cell = march_cell_at(m.origin, m.direction, t, m.resolution);
    bvec2 up = greaterThan(m.step_direction, ivec2(0));
    bvec2 still = equal(m.step_direction, ivec2(0));
    // The march never goes back.
    m.cell = mix(mix(min(cell, m.cell), max(cell, m.cell), up), m.cell, still);
    m.t_in = t;
    m.error_in = error;
    march_find_exit(m);
    m.neighbours = 0u;
    return true;
}

// Returns the t at which the ray entered the tile it has jumped to, but not before `t_begin`.
float primitive_jumped_entry(CellMarch m, float t_begin) {
    float t_in = t_begin;
    for (int axis = 0; axis < 2; axis++) {
        int way = m.step_direction[axis];
        if (way != 0) {
            float error;
            float side = cell_boundary(m.cell[axis] + (way > 0 ? 0 : 1), m.resolution);
            float t = march_crossing(side, m.origin[axis], m.direction[axis], m.origin.z, m.direction.z, way, error);
            t_in = t < m.t_in ? max(t_in, t) : t_in;
        }
    }
    return t_in;
}

#endif

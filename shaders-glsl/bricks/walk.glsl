// Where a ray is among the cells of bricks: its line in a view, the cell it is in, and the next one; the cursor of a
// paused ray.
// Reads: header. Writes: nothing.
// Source: DIRT section 3.3, by cells of (column, row, slice) in bricks; bricks/cube.glsl has the planes
// between them, and ads/box_cells.glsl those of views along axes (BRICKS_VIEWS), which have one view and
// no near region. Every step goes from t to where the ray leaves the cell, or the empty cells around it; the
// axis of that exit gets the next index exactly, the others are found from the point there and clamped between
// their previous values and the end of the empty cells. So indices only go forwards, and a cell is missed by no more
// than rounding, for which its list has a margin.
//
// cursor: 0 flags and face
//         1 t
//         2 column and row
//         3 slice
//         4 next entry
#ifndef BRICKS_WALK_GLSL
#define BRICKS_WALK_GLSL

#include "contract/bits.glsl"
#include "contract/trace_state.glsl"
#include "bricks/cell.glsl"
#include "bricks/cube.glsl"

// Fields of the flags.
#define BRICKS_CURSOR_STARTED 0, 1
#define BRICKS_CURSOR_LISTED 1, 1
#define BRICKS_CURSOR_FACE 2, 3
// Value of the next entry if the list of the cell has not been begun.
#define BRICKS_LIST_BEGIN 0xFFFFFFFFu

// Triangles that are tested one by one before the ray is followed.
#define BRICKS_ALONE_NONE 0u
#define BRICKS_ALONE_NEAR 1u
#define BRICKS_ALONE_ALL 2u

// Part of a ray that is followed.
struct BricksSpan {
    vec3 origin;          // of the ray, metres relative to the centre
    float t_first;
    float t_last;
    vec2 near;            // t where the ray enters and leaves the near region; none if x > y
    float slack;          // of t: a cell behind the best hit by more than this cannot hold a nearer one
};

// Place of a ray among the cells.
struct BricksWalk {
    float t;
    uint face;            // of the cube; 0 in views along axes
    ivec3 cell;           // one of the smallest
    uint entry;           // the next of the cell's list, or BRICKS_LIST_BEGIN
    bool turns;           // it comes into a view: its line there is to be found
    bool begins;          // and so is its cell
    bool paused;          // the budget ended
};

// Line of a ray in a view.
struct BricksLine {
    BricksRay in_face;    // of a face of the cube
    BoxLine along_axes;   // of a view along axes
    bvec3 up;             // indices grow along the axis
};

BricksTraversal bricks_traversal(BricksRef s) {
    BricksTraversal traversal;
    traversal.shift = 2 * ivec3(bricks_divisions(s, BRICKS_DEPTH));
    traversal.cells = ivec3(bricks_cells(s)) << traversal.shift;
    traversal.bricks = bricks_stored(s);
    traversal.steepness = 1.0;
    traversal.slices = bricks_slices(s);
    traversal.half_side = 0.5 * float(traversal.cells.x);
    traversal.column = 2.0 / float(traversal.cells.x);
    traversal.rounding = BRICKS_PLACE * BRICKS_HEADER(s).reach;
    traversal.stored = min(BRICKS_HEADER(s).capacity, BRICKS_HEADER(s).demand);
    traversal.listed = bricks_listed_cells(s);
    return traversal;
}

// Returns the place where a ray begins: that of the cursor if it is `resumed`, otherwise the begin of the
// span or the end of the near region.
BricksWalk bricks_walk_begin(BricksSpan span, vec3 direction, uint alone, bool resumed, TraceState state) {
    BricksWalk walk = BricksWalk(span.t_first, 0u, ivec3(0), BRICKS_LIST_BEGIN, true, true, false);
    walk.begins = !resumed || alone != BRICKS_ALONE_NONE;
    if (resumed) {
        walk.entry = state.cursor[4];
    }
    if (!walk.begins) {
        walk.face = bits_get(state.cursor[0], BRICKS_CURSOR_FACE);
        walk.t = uintBitsToFloat(state.cursor[1]);
        walk.cell = ivec3(cell_of_bits(state.cursor[2]), state.cursor[3]);
    } else if (span.near.x <= walk.t && walk.t <= span.near.y) {
        walk.t = span.near.y;
    }
    if (walk.begins && BRICKS_VIEWS != BRICKS_VIEWS_AXES) {
        walk.face = face_of(span.origin + walk.t * direction);
    }
    return walk;
}

// Stores in the cursor the place of a ray, and the triangles that are tested one by one before it is followed
// (BRICKS_ALONE_*).
void bricks_walk_keep(BricksWalk walk, uint alone, inout TraceState state) {
    state.cursor[0] = bits_put(true, BRICKS_CURSOR_STARTED) | bits_put(walk.face, BRICKS_CURSOR_FACE)
        | bits_put(alone != BRICKS_ALONE_NONE, BRICKS_CURSOR_LISTED);
    state.cursor[1] = floatBitsToUint(walk.t);
    state.cursor[2] = bits_of_cell(walk.cell.xy);
    state.cursor[3] = uint(walk.cell.z);
    state.cursor[4] = walk.entry;
}

// Returns the line of a ray in a view.
BricksLine bricks_line(BricksRef s, vec3 origin, vec3 direction, uint face) {
    BricksLine line;
    if (BRICKS_VIEWS == BRICKS_VIEWS_AXES) {
        line.along_axes = box_line(bricks_axes(s, BRICKS_DEPTH), origin, direction);
        line.up = greaterThanEqual(line.along_axes.direction, vec3(0.0));
    } else {
        line.in_face = bricks_ray(origin, direction, face);
        line.up = greaterThanEqual(line.in_face.heading, vec3(0.0));
    }
    return line;
}

// Returns the number of rows that a line along axes crosses for each column or slice, whichever are more.
float bricks_line_steepness(BricksLine line) {
    vec3 speed = abs(line.along_axes.direction);
    return speed.y / max(speed.x, speed.z);
}

// Returns the cell at t, which may be outside the view.
ivec3 bricks_line_cell_at(BricksLine line, BricksTraversal traversal, float t) {
    return BRICKS_VIEWS == BRICKS_VIEWS_AXES ? box_line_cell_at(line.along_axes, t, traversal.cells)
        : bricks_cell_at(line.in_face, t, traversal.half_side, traversal.rounding, traversal.slices);
}

// Returns the t at which the line leaves a box along each axis.
vec3 bricks_line_exits(BricksLine line, BricksTraversal traversal, BricksBox box) {
    ivec3 planes = mix(box.first, box.last + 1, line.up);
    return BRICKS_VIEWS == BRICKS_VIEWS_AXES ? box_line_exits(line.along_axes, planes)
        : bricks_exits(line.in_face, planes, traversal.column, traversal.slices);
}

// Returns the cell behind a box that is left along one axis, at t and from a cell within: along columns,
// along rows, or else along slices. The cell may be outside the view.
ivec3 bricks_next_cell(BricksLine line, BricksTraversal traversal, BricksBox box, ivec3 cell, float t, bool leaves_x, bool leaves_y) {
    ivec3 next = bricks_line_cell_at(line, traversal, t);
    next = clamp(next, mix(box.first, cell, line.up), mix(cell, box.last, line.up));
    ivec3 over = mix(box.first - 1, box.last + 1, line.up);
    if (leaves_x) {
        next.x = over.x;
    } else if (leaves_y) {
        next.y = over.y;
    } else {
        next.z = over.z;
    }
    return next;
}

#endif

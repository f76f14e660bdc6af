// Where a ray is among the cells of bricks: its line in a view, its cell, the next cell, and the cursor of a
// paused ray.
// Reads: header. Writes: nothing.
// Source: DIRT section 3.3; here cells have a column, a row and a slice, and are grouped in bricks.
// bricks/cube.glsl has the planes between the cells of a cube's faces, ads/box_cells.glsl those of a view
// along an axis (BRICKS_VIEWS). With the latter there is a single view and no near region.
// A step goes from t to where the ray leaves its cell, or the box of empty cells around it. Along the axis of
// that exit the next index is exact. Along the other axes it follows from the exit point, clamped between the
// index so far and the end of the box. So indices only change in the direction of the ray. The march misses a
// cell that the exact ray crosses only if the ray is within rounding of the cell's side, for which lists have
// a margin.
// Words of the cursor: 0 flags and the face; 1 t; 2 column and row; 3 slice; 4 the next entry.
#ifndef BRICKS_WALK_GLSL
#define BRICKS_WALK_GLSL

#include "contract/bits.glsl"
#include "contract/trace_state.glsl"
#include "bricks/cell.glsl"
#include "bricks/cube.glsl"

// Fields of word 0 of the cursor (contract/bits.glsl).
#define BRICKS_CURSOR_STARTED 0, 1
#define BRICKS_CURSOR_LISTED 1, 1
#define BRICKS_CURSOR_FACE 2, 3
// Value of the next entry if the list of the cell has not been begun.
#define BRICKS_LIST_BEGIN 0xFFFFFFFFu

// Which triangles are tested one by one before the ray is marched: none, those of the near-region list, or
// all.
#define BRICKS_ALONE_NONE 0u
#define BRICKS_ALONE_NEAR 1u
#define BRICKS_ALONE_ALL 2u

// The part of a ray that is marched.
struct BricksSpan {
    vec3 origin;          // origin of the ray relative to the centre, metres
    float t_first;        // t at which the part begins
    float t_last;         // t at which it ends
    vec2 near;            // interval of t in which the ray is in the near region; none if x > y
    // bound of the error of t: a cell that begins this far behind the best hit holds no nearer hit
    float slack;
};

// The position of a ray among the cells.
struct BricksWalk {
    float t;              // t at which the ray enters the cell
    uint face;            // face of the cube; 0 in a view along an axis
    ivec3 cell;           // cell, counted in smallest cells
    uint entry;           // next entry of the cell's list, or BRICKS_LIST_BEGIN
    bool turns;           // true if the ray enters a view: its line there must be found
    bool begins;          // true if its cell there must be found, too
    bool paused;          // true if the work budget is spent
};

// The line of a ray in a view.
struct BricksLine {
    BricksRay in_face;    // used in a face of a cube
    BoxLine along_axes;   // used in a view along an axis
    bvec3 up;             // true where indices grow along the ray
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

// Returns the position at which a ray begins. If the march is `resumed`, it is that of the cursor; otherwise
// it is the begin of the span, or the end of the near region if the span begins in the region.
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

// Stores the position of a ray in the cursor, and whether triangles are still tested one by one
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

// Returns the number of rows that a line in a view along an axis crosses per column or per slice, whichever
// of these it crosses more of.
float bricks_line_steepness(BricksLine line) {
    vec3 speed = abs(line.along_axes.direction);
    return speed.y / max(speed.x, speed.z);
}

// Returns the cell that the line is in at t. In a face of a cube the cell may be outside the view.
ivec3 bricks_line_cell_at(BricksLine line, BricksTraversal traversal, float t) {
    return BRICKS_VIEWS == BRICKS_VIEWS_AXES ? box_line_cell_at(line.along_axes, t, traversal.cells)
        : bricks_cell_at(line.in_face, t, traversal.half_side, traversal.rounding, traversal.slices);
}

// Returns the t at which the line leaves a box by a side across each axis.
vec3 bricks_line_exits(BricksLine line, BricksTraversal traversal, BricksBox box) {
    ivec3 planes = mix(box.first, box.last + 1, line.up);
    return BRICKS_VIEWS == BRICKS_VIEWS_AXES ? box_line_exits(line.along_axes, planes)
        : bricks_exits(line.in_face, planes, traversal.column, traversal.slices);
}

// Returns the cell that a ray enters when it leaves a box at t, from the cell `cell` of the box: across
// columns if `leaves_x`, across rows if `leaves_y`, else across slices. The cell may be outside the view.
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

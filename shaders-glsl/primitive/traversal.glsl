// The state of a ray's traversal, and how it is stored in the cursor of a paused ray.
// Reads: header. Writes: nothing.
// Words of the cursor: 0 flags; 1 and 2 the ends of the segment; 3 the cell of the march; 4 and 5 t of its
// entry and the bound of its error; 6 the position in the list; 7 the cell that is searched, or the place
// among the triangles that are tested one by one.
#ifndef PRIMITIVE_TRAVERSAL_GLSL
#define PRIMITIVE_TRAVERSAL_GLSL

#include "contract/bits.glsl"
#include "ads/march_cube.glsl"
#include "primitive/jump.glsl"
#include "primitive/search.glsl"

// Fields of the flags in word 0 of the cursor (contract/bits.glsl).
#define PRIMITIVE_CURSOR_STARTED 0, 1
#define PRIMITIVE_CURSOR_SEARCHING 1, 1
#define PRIMITIVE_CURSOR_FACE 2, 3
#define PRIMITIVE_CURSOR_IN_LIST 5, 1
#define PRIMITIVE_CURSOR_NEIGHBOURS 6, 9
#define PRIMITIVE_CURSOR_FOUND 15, 1
#define PRIMITIVE_CURSOR_BUCKET 16, 6

// The traversal of a ray along one segment: within a face, within the near region, or among all triangles.
struct PrimitiveTraversal {
    Segment segment;      // the segment, and where it lies
    vec3 origin;          // origin of the ray in face space, metres from the centre
    vec3 direction;       // direction of the ray in face space
    CellMarch cells;      // march through the cells of the face
    uint place;           // place among the triangles that are tested one by one
    ivec2 searched;       // cell that is searched: the cell of the march, or a neighbour of it
    bool searching;       // true once its search has begun
    PrimitiveSearch search;  // search of the cell
};

bool primitive_traverses_cells(PrimitiveTraversal traversal) {
    return traversal.segment.face < SEGMENT_NEAR;
}

void primitive_begin_traversal(PrimitiveRef s, vec3 origin, vec3 direction, inout PrimitiveTraversal traversal) {
    traversal.place = 0u;
    traversal.searching = false;
    traversal.search.begun = false;
    traversal.search.in_list = false;
    traversal.search.found = false;
    if (primitive_traverses_cells(traversal)) {
        traversal.origin = face_from_world(origin, traversal.segment.face);
        traversal.direction = face_from_world(direction, traversal.segment.face);
        traversal.cells = march_begin(traversal.origin, traversal.direction, PRIMITIVE_HEADER(s).tiles,
            traversal.segment.t_begin, traversal.segment.t_end,
            traversal.segment.t_error);
        traversal.searched = traversal.cells.cell;
        if (PRIMITIVE_MARCH == PRIMITIVE_MARCH_JUMP) {
            traversal.cells.neighbours = 0u;
        }
    }
}

// Prepares the search of the cell that the traversal is at.
void primitive_begin_search(PrimitiveRef s, inout PrimitiveTraversal traversal) {
    traversal.search.t_low = traversal.cells.t_in - traversal.cells.error_in;
    if (PRIMITIVE_MARCH == PRIMITIVE_MARCH_JUMP) {
        traversal.search.t_low = min(traversal.search.t_low, primitive_jumped_entry(traversal.cells,
            traversal.segment.t_begin));
    }
    traversal.search.t_high = traversal.cells.t_out + traversal.cells.error_out;
    traversal.search.cell = cell_index(traversal.segment.face, traversal.searched, PRIMITIVE_HEADER(s).tiles);
}

// Goes to the next cell; returns false if there is none in the segment.
bool primitive_next_cell(PrimitiveRef s, inout PrimitiveTraversal traversal) {
    traversal.searching = false;
    traversal.search.begun = false;
    traversal.search.in_list = false;
    traversal.search.found = false;
    if (PRIMITIVE_MARCH == PRIMITIVE_MARCH_JUMP) {
        bool jumped = primitive_jump(s, traversal.cells, march_skip_of_one(traversal.cells));
        traversal.searched = traversal.cells.cell;
        return jumped;
    }
    if (march_take_neighbour(traversal.cells, traversal.searched)) {
        return true;
    }
    bool more = march_next(traversal.cells);
    traversal.searched = traversal.cells.cell;
    return more;
}

void primitive_save(PrimitiveTraversal traversal, inout TraceState state) {
    bool cells = primitive_traverses_cells(traversal);
    state.cursor[0] = bits_put(true, PRIMITIVE_CURSOR_STARTED) | bits_put(traversal.searching,
        PRIMITIVE_CURSOR_SEARCHING)
        | bits_put(traversal.segment.face, PRIMITIVE_CURSOR_FACE) | bits_put(traversal.search.in_list,
        PRIMITIVE_CURSOR_IN_LIST)
        | bits_put(cells ? traversal.cells.neighbours : 0u, PRIMITIVE_CURSOR_NEIGHBOURS)
        | bits_put(traversal.search.found, PRIMITIVE_CURSOR_FOUND)
        | bits_put(cells ? traversal.search.bucket : 0u, PRIMITIVE_CURSOR_BUCKET);
    state.cursor[1] = floatBitsToUint(traversal.segment.t_begin);
    state.cursor[2] = floatBitsToUint(traversal.segment.t_end);
    state.cursor[3] = bits_of_cell(traversal.cells.cell);
    state.cursor[4] = floatBitsToUint(traversal.cells.t_in);
    state.cursor[5] = floatBitsToUint(traversal.cells.error_in);
    state.cursor[6] = traversal.search.list.at;
    state.cursor[7] = cells ? bits_of_cell(traversal.searched) : traversal.place;
}

void primitive_restore(PrimitiveRef s, vec3 origin, vec3 direction, vec2 near, TraceState state,
    out PrimitiveTraversal traversal) {
    uint flags = state.cursor[0];
    traversal.segment = segment_at(origin, direction, uintBitsToFloat(state.cursor[1]),
        uintBitsToFloat(state.cursor[2]), near);
    traversal.segment.face = bits_get(flags, PRIMITIVE_CURSOR_FACE);
    traversal.segment.t_end = uintBitsToFloat(state.cursor[2]);
    primitive_begin_traversal(s, origin, direction, traversal);
    traversal.place = state.cursor[7];
    if (!primitive_traverses_cells(traversal)) {
        return;
    }
    traversal.cells.cell = cell_of_bits(state.cursor[3]);
    traversal.cells.t_in = uintBitsToFloat(state.cursor[4]);
    traversal.cells.error_in = uintBitsToFloat(state.cursor[5]);
    march_find_exit(traversal.cells);
    traversal.cells.neighbours = bits_get(flags, PRIMITIVE_CURSOR_NEIGHBOURS);
    traversal.searched = cell_of_bits(state.cursor[7]);
    traversal.searching = bits_are_set(flags, PRIMITIVE_CURSOR_SEARCHING);
    traversal.search.begun = traversal.searching;
    traversal.search.in_list = bits_are_set(flags, PRIMITIVE_CURSOR_IN_LIST);
    traversal.search.found = bits_are_set(flags, PRIMITIVE_CURSOR_FOUND);
    traversal.search.bucket = bits_get(flags, PRIMITIVE_CURSOR_BUCKET);
    if (traversal.search.in_list) {
        uint cell = cell_index(traversal.segment.face, traversal.searched, PRIMITIVE_HEADER(s).tiles);
        traversal.search.list = primitive_list_resume(s, primitive_list(cell, traversal.search.bucket),
            state.cursor[6]);
    }
}

#endif

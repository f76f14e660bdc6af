// What: the position of a ray's traversal through the cells, and how it is saved between two dispatches.
// Reads: header. Writes: nothing.
// cursor: 0 flags, 1 and 2 ends of the segment, 3 cell, 4 and 5 entry and its error, 6 entry of the list,
// 7 the cell being searched, or the place in what is tested one by one.
#ifndef PRIMITIVE_WALK_GLSL
#define PRIMITIVE_WALK_GLSL

#include "contract/bits.glsl"
#include "ads/march_cube.glsl"
#include "primitive/jump.glsl"
#include "primitive/search.glsl"

// Fields of the flags.
#define PRIMITIVE_CURSOR_STARTED 0, 1
#define PRIMITIVE_CURSOR_SEARCHING 1, 1
#define PRIMITIVE_CURSOR_FACE 2, 3
#define PRIMITIVE_CURSOR_IN_LIST 5, 1
#define PRIMITIVE_CURSOR_NEIGHBOURS 6, 9
#define PRIMITIVE_CURSOR_FOUND 15, 1
#define PRIMITIVE_CURSOR_BUCKET 16, 6

// A ray within one face, within the near region, or among all triangles.
struct PrimitiveWalk {
    Segment segment;
    vec3 origin;          // face space
    vec3 direction;
    CellMarch cells;
    uint place;           // of what is tested one by one
    ivec2 searched;       // the cell being searched
    bool searching;       // its search has been begun
    PrimitiveSearch search;
};

bool primitive_walks_cells(PrimitiveWalk walk) {
    return walk.segment.face < SEGMENT_NEAR;
}

void primitive_begin_walk(PrimitiveRef s, vec3 origin, vec3 direction, inout PrimitiveWalk walk) {
    walk.place = 0u;
    walk.searching = false;
    walk.search.begun = false;
    walk.search.in_list = false;
    walk.search.found = false;
    if (primitive_walks_cells(walk)) {
        walk.origin = face_from_world(origin, walk.segment.face);
        walk.direction = face_from_world(direction, walk.segment.face);
        walk.cells = march_begin(walk.origin, walk.direction, PRIMITIVE_HEADER(s).tiles, walk.segment.t_begin, walk.segment.t_end,
            walk.segment.t_error);
        walk.searched = walk.cells.cell;
        if (PRIMITIVE_MARCH == PRIMITIVE_MARCH_JUMP) {
            walk.cells.neighbours = 0u;
        }
    }
}

// Prepares the search of the cell the traversal is at.
void primitive_begin_search(PrimitiveRef s, inout PrimitiveWalk walk) {
    walk.search.t_low = walk.cells.t_in - walk.cells.error_in;
    if (PRIMITIVE_MARCH == PRIMITIVE_MARCH_JUMP) {
        walk.search.t_low = min(walk.search.t_low, primitive_jumped_entry(walk.cells, walk.segment.t_begin));
    }
    walk.search.t_high = walk.cells.t_out + walk.cells.error_out;
    walk.search.cell = cell_index(walk.segment.face, walk.searched, PRIMITIVE_HEADER(s).tiles);
}

// Goes to the next cell; false at the end of the segment.
bool primitive_next_cell(PrimitiveRef s, inout PrimitiveWalk walk) {
    walk.searching = false;
    walk.search.begun = false;
    walk.search.in_list = false;
    walk.search.found = false;
    if (PRIMITIVE_MARCH == PRIMITIVE_MARCH_JUMP) {
        bool jumped = primitive_jump(s, walk.cells, march_leap_of_one(walk.cells));
        walk.searched = walk.cells.cell;
        return jumped;
    }
    if (march_take_neighbour(walk.cells, walk.searched)) {
        return true;
    }
    bool more = march_next(walk.cells);
    walk.searched = walk.cells.cell;
    return more;
}

void primitive_save(PrimitiveWalk walk, inout TraceState state) {
    bool cells = primitive_walks_cells(walk);
    state.cursor[0] = bits_put(true, PRIMITIVE_CURSOR_STARTED) | bits_put(walk.searching, PRIMITIVE_CURSOR_SEARCHING)
        | bits_put(walk.segment.face, PRIMITIVE_CURSOR_FACE) | bits_put(walk.search.in_list, PRIMITIVE_CURSOR_IN_LIST)
        | bits_put(cells ? walk.cells.neighbours : 0u, PRIMITIVE_CURSOR_NEIGHBOURS)
        | bits_put(walk.search.found, PRIMITIVE_CURSOR_FOUND)
        | bits_put(cells ? walk.search.bucket : 0u, PRIMITIVE_CURSOR_BUCKET);
    state.cursor[1] = floatBitsToUint(walk.segment.t_begin);
    state.cursor[2] = floatBitsToUint(walk.segment.t_end);
    state.cursor[3] = bits_of_cell(walk.cells.cell);
    state.cursor[4] = floatBitsToUint(walk.cells.t_in);
    state.cursor[5] = floatBitsToUint(walk.cells.error_in);
    state.cursor[6] = walk.search.list.at;
    state.cursor[7] = cells ? bits_of_cell(walk.searched) : walk.place;
}

void primitive_restore(PrimitiveRef s, vec3 origin, vec3 direction, vec2 near, TraceState state, out PrimitiveWalk walk) {
    uint flags = state.cursor[0];
    walk.segment = segment_at(origin, direction, uintBitsToFloat(state.cursor[1]), uintBitsToFloat(state.cursor[2]), near);
    walk.segment.face = bits_get(flags, PRIMITIVE_CURSOR_FACE);
    walk.segment.t_end = uintBitsToFloat(state.cursor[2]);
    primitive_begin_walk(s, origin, direction, walk);
    walk.place = state.cursor[7];
    if (!primitive_walks_cells(walk)) {
        return;
    }
    walk.cells.cell = cell_of_bits(state.cursor[3]);
    walk.cells.t_in = uintBitsToFloat(state.cursor[4]);
    walk.cells.error_in = uintBitsToFloat(state.cursor[5]);
    march_find_exit(walk.cells);
    walk.cells.neighbours = bits_get(flags, PRIMITIVE_CURSOR_NEIGHBOURS);
    walk.searched = cell_of_bits(state.cursor[7]);
    walk.searching = bits_are_set(flags, PRIMITIVE_CURSOR_SEARCHING);
    walk.search.begun = walk.searching;
    walk.search.in_list = bits_are_set(flags, PRIMITIVE_CURSOR_IN_LIST);
    walk.search.found = bits_are_set(flags, PRIMITIVE_CURSOR_FOUND);
    walk.search.bucket = bits_get(flags, PRIMITIVE_CURSOR_BUCKET);
    if (walk.search.in_list) {
        uint cell = cell_index(walk.segment.face, walk.searched, PRIMITIVE_HEADER(s).tiles);
        walk.search.list = primitive_list_resume(s, primitive_list(cell, walk.search.bucket), state.cursor[6]);
    }
}

#endif

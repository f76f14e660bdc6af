// What: the position of a ray's traversal through the cells of a view, and how it is saved between two dispatches.
// Reads: header. Writes: nothing.
// cursor: 0 flags, 1 and 2 ends of the segment, 3 cell, 4 and 5 entry and its error, 6 next node of the list,
// 7 the cell being searched, or the sample, or the place in the near-region list.
#ifndef ABUFFER_WALK_GLSL
#define ABUFFER_WALK_GLSL

#include "contract/bits.glsl"
#include "ads/march_cells.glsl"
#include "ads/march_samples.glsl"
#include "abuffer/search.glsl"
#include "abuffer/segments.glsl"

// Fields of the flags.
#define ABUFFER_CURSOR_STARTED 0, 1
#define ABUFFER_CURSOR_SEARCHING 1, 1
#define ABUFFER_CURSOR_VIEW 2, 3
#define ABUFFER_CURSOR_IN_BUCKET 5, 1
#define ABUFFER_CURSOR_NEIGHBOURS 6, 9
#define ABUFFER_CURSOR_IN_FRINGE 15, 1
#define ABUFFER_CURSOR_BUCKET 16, 5
#define ABUFFER_CURSOR_STAGE 21, 2

// A ray within one view or the near region.
struct AbufferWalk {
    Segment segment;
    AbufferStretch stretch;
    vec3 origin;          // in the view
    vec3 direction;
    CellMarch cells;
    SampleMarch samples;
    bool came;            // the exit of the current cell is still to be found
    bool resumed;         // in that cell, with some of its neighbours
    uint place;           // sample, or entry of the near-region list
    ivec2 searched;       // the cell being searched
};

// The traversal is at the cell of its march.
void abuffer_come_to(inout AbufferWalk walk) {
    walk.searched = walk.cells.cell;
    walk.came = true;
}

// Finds the way out of the cell that a traversal is at.
void abuffer_find_exit(inout AbufferWalk walk) {
    if (!ABUFFER_FOLLOWS_CELLS || !walk.came) {
        return;
    }
    uint left = walk.cells.neighbours;
    march_find_exit(walk.cells);
    walk.cells.neighbours = walk.resumed ? left : walk.cells.neighbours;
    walk.came = false;
    walk.resumed = false;
}

void abuffer_begin_walk(AbufferRef s, vec3 origin, vec3 direction, inout AbufferWalk walk) {
    uint resolution = abuffer_resolution(s, walk.segment.face);
    walk.origin = abuffer_view_from_world(s, origin, walk.segment.face);
    walk.direction = abuffer_view_from_world(s, direction, walk.segment.face);
    walk.place = 0u;
    walk.came = false;
    walk.resumed = false;
    if (walk.segment.face == SEGMENT_NEAR) {
        return;
    }
    if (ABUFFER_FOLLOWS_CELLS) {
        walk.cells = march_place(walk.origin, walk.direction, resolution, walk.segment.t_begin, walk.segment.t_end, walk.segment.t_error);
        abuffer_come_to(walk);
    } else {
        walk.samples = samples_begin(walk.origin, walk.direction, resolution, walk.segment.t_begin, walk.segment.t_end,
            ABUFFER_MARCH == ABUFFER_MARCH_DDA ? 0xFFFFu : ABUFFER_HEADER(s).samples,
            ABUFFER_JITTER != 0u ? samples_jitter(origin, direction) : 0.5);
    }
}

void abuffer_save(AbufferWalk walk, AbufferSearch search, bool searching, inout TraceState state) {
    state.cursor[0] = bits_put(true, ABUFFER_CURSOR_STARTED) | bits_put(searching, ABUFFER_CURSOR_SEARCHING)
        | bits_put(walk.segment.face, ABUFFER_CURSOR_VIEW) | bits_put(search.in_bucket, ABUFFER_CURSOR_IN_BUCKET)
        | bits_put(walk.cells.neighbours, ABUFFER_CURSOR_NEIGHBOURS) | bits_put(search.in_fringe, ABUFFER_CURSOR_IN_FRINGE)
        | bits_put(search.bucket, ABUFFER_CURSOR_BUCKET) | bits_put(walk.stretch.stage, ABUFFER_CURSOR_STAGE);
    state.cursor[1] = floatBitsToUint(walk.segment.t_begin);
    state.cursor[2] = floatBitsToUint(walk.segment.t_end);
    state.cursor[3] = bits_of_cell(walk.cells.cell);
    state.cursor[4] = floatBitsToUint(walk.cells.t_in);
    state.cursor[5] = floatBitsToUint(walk.cells.error_in);
    state.cursor[6] = search.link;
    bool in_cells = ABUFFER_FOLLOWS_CELLS && walk.segment.face != SEGMENT_NEAR;
    state.cursor[7] = in_cells ? bits_of_cell(walk.searched) : walk.place;
}

// Restores the segment that a paused ray was in.
void abuffer_restore_stretch(TraceState state, vec2 clip, out AbufferStretch stretch, out vec2 ends, out uint view) {
    uint flags = state.cursor[0];
    view = bits_get(flags, ABUFFER_CURSOR_VIEW);
    ends = vec2(uintBitsToFloat(state.cursor[1]), uintBitsToFloat(state.cursor[2]));
    // Before the faces none of them has been followed.
    bool in_faces = view != ABUFFER_CAMERA && ABUFFER_HAS_CUBE;
    stretch = AbufferStretch(bits_get(flags, ABUFFER_CURSOR_STAGE), in_faces ? ends.y : clip.x);
}

// Where the ray was in that segment, whose traversal has been begun.
void abuffer_restore(TraceState state, inout AbufferWalk walk, out AbufferSearch search) {
    uint flags = state.cursor[0];
    walk.place = state.cursor[7];
    if (ABUFFER_FOLLOWS_CELLS && walk.segment.face != SEGMENT_NEAR) {
        walk.cells.cell = cell_of_bits(state.cursor[3]);
        walk.cells.t_in = uintBitsToFloat(state.cursor[4]);
        walk.cells.error_in = uintBitsToFloat(state.cursor[5]);
        walk.cells.neighbours = bits_get(flags, ABUFFER_CURSOR_NEIGHBOURS);
        walk.came = true;
        walk.resumed = true;
        walk.searched = cell_of_bits(state.cursor[7]);
    }
    search.in_bucket = bits_are_set(flags, ABUFFER_CURSOR_IN_BUCKET);
    search.in_fringe = bits_are_set(flags, ABUFFER_CURSOR_IN_FRINGE);
    search.bucket = search.in_bucket ? bits_get(flags, ABUFFER_CURSOR_BUCKET) : 0u;
    search.link = state.cursor[6];
}

// Prepares the search of the cell the traversal is at; `begun` where it goes on.
void abuffer_begin_search(AbufferRef s, bool begun, inout AbufferWalk walk, inout AbufferSearch search) {
    if (!begun) {
        search.in_bucket = false;
        search.in_fringe = false;
        search.bucket = 0u;
        search.link = 0u;
    }
    if (ABUFFER_FOLLOWS_CELLS) {
        search.t_low = walk.cells.t_in - walk.cells.error_in;
        search.t_high = walk.cells.t_out + walk.cells.error_out;
    } else {
        samples_cell(walk.samples, walk.place, walk.searched, search.t_low, search.t_high);
    }
    search.view = walk.segment.face;
    search.place = walk.searched;
    search.cell = abuffer_cell(s, search.view, search.place);
    vec2 z = walk.origin.z + vec2(search.t_low, search.t_high) * walk.direction.z;
    search.z = vec2(min(z.x, z.y), max(z.x, z.y));
    search.rounding = ABUFFER_HEADER(s).rounding
        + 4.8e-7 * (abs(walk.origin.z) + max(abs(search.t_low), abs(search.t_high)) * abs(walk.direction.z));
}

// Goes to the next cell; false at the end of the segment.
bool abuffer_next_cell(inout AbufferWalk walk) {
    if (ABUFFER_FOLLOWS_CELLS) {
        if (march_take_neighbour(walk.cells, walk.searched)) {
            return true;
        }
        bool more = march_step(walk.cells);
        abuffer_come_to(walk);
        return more;
    }
    walk.place++;
    return walk.place < walk.samples.count;
}

#endif

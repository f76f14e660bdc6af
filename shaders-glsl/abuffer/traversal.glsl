// Holds the position of a ray's traversal through the cells of a view, and saves it between two dispatches.
// Reads: header. Writes: nothing.
// Words of the cursor: 0 flags; 1 and 2 the ends of the segment; 3 the cell of the march; 4 and 5 t at the
// entry into that cell, and its error; 6 the next node of the list; 7 the cell being searched, or the number
// of the sample, or the place in the near-region list.
#ifndef ABUFFER_TRAVERSAL_GLSL
#define ABUFFER_TRAVERSAL_GLSL

#include "contract/bits.glsl"
#include "ads/march_cells.glsl"
#include "ads/march_samples.glsl"
#include "abuffer/search.glsl"
#include "abuffer/segments.glsl"

// Fields of the cursor's flags: first bit and width (contract/bits.glsl).
#define ABUFFER_CURSOR_STARTED 0, 1
#define ABUFFER_CURSOR_SEARCHING 1, 1
#define ABUFFER_CURSOR_VIEW 2, 3
#define ABUFFER_CURSOR_IN_BUCKET 5, 1
#define ABUFFER_CURSOR_NEIGHBOURS 6, 9
#define ABUFFER_CURSOR_IN_CONSERVATIVE 15, 1
#define ABUFFER_CURSOR_BUCKET 16, 5
#define ABUFFER_CURSOR_STAGE 21, 2

// Traversal of a ray within one view or the near region.
struct AbufferTraversal {
    Segment segment;
    AbufferProgress progress;
    vec3 origin;          // in the frame of the view, metres
    vec3 direction;
    CellMarch cells;
    SampleMarch samples;
    bool entered;            // true while the exit of the march's cell is still to be found
    bool resumed;         // true if the ray paused in that cell, after some of its neighbours
    uint place;           // number of the sample, or place in the near-region list
    ivec2 searched;       // the cell being searched: that of the march, or a neighbour
};

// Makes the cell of the march the cell to search; its exit is still to be found.
void abuffer_enter_cell(inout AbufferTraversal traversal) {
    traversal.searched = traversal.cells.cell;
    traversal.entered = true;
}

// Finds the exit from the cell of the march, if it is still to be found.
void abuffer_find_exit(inout AbufferTraversal traversal) {
    if (!ABUFFER_FOLLOWS_CELLS || !traversal.entered) {
        return;
    }
    uint left = traversal.cells.neighbours;
    march_find_exit(traversal.cells);
    traversal.cells.neighbours = traversal.resumed ? left : traversal.cells.neighbours;
    traversal.entered = false;
    traversal.resumed = false;
}

void abuffer_begin_traversal(AbufferRef s, vec3 origin, vec3 direction, inout AbufferTraversal traversal) {
    uint resolution = abuffer_resolution(s, traversal.segment.face);
    traversal.origin = abuffer_view_from_world(s, origin, traversal.segment.face);
    traversal.direction = abuffer_view_from_world(s, direction, traversal.segment.face);
    traversal.place = 0u;
    traversal.entered = false;
    traversal.resumed = false;
    if (traversal.segment.face == SEGMENT_NEAR) {
        return;
    }
    if (ABUFFER_FOLLOWS_CELLS) {
        traversal.cells = march_place(traversal.origin, traversal.direction, resolution, traversal.segment.t_begin,
            traversal.segment.t_end, traversal.segment.t_error);
        abuffer_enter_cell(traversal);
    } else {
        traversal.samples = samples_begin(traversal.origin, traversal.direction, resolution, traversal.segment.t_begin,
            traversal.segment.t_end,
            ABUFFER_MARCH == ABUFFER_MARCH_DDA ? 0xFFFFu : ABUFFER_HEADER(s).samples,
            ABUFFER_JITTER != 0u ? samples_jitter(origin, direction) : 0.5);
    }
}

void abuffer_save(AbufferTraversal traversal, AbufferSearch search, bool searching, inout TraceState state) {
    state.cursor[0] = bits_put(true, ABUFFER_CURSOR_STARTED) | bits_put(searching, ABUFFER_CURSOR_SEARCHING)
        | bits_put(traversal.segment.face, ABUFFER_CURSOR_VIEW) | bits_put(search.in_bucket, ABUFFER_CURSOR_IN_BUCKET)
        | bits_put(traversal.cells.neighbours, ABUFFER_CURSOR_NEIGHBOURS) | bits_put(search.in_conservative,
        ABUFFER_CURSOR_IN_CONSERVATIVE)
        | bits_put(search.bucket, ABUFFER_CURSOR_BUCKET) | bits_put(traversal.progress.stage, ABUFFER_CURSOR_STAGE);
    state.cursor[1] = floatBitsToUint(traversal.segment.t_begin);
    state.cursor[2] = floatBitsToUint(traversal.segment.t_end);
    state.cursor[3] = bits_of_cell(traversal.cells.cell);
    state.cursor[4] = floatBitsToUint(traversal.cells.t_in);
    state.cursor[5] = floatBitsToUint(traversal.cells.error_in);
    state.cursor[6] = search.link;
    bool in_cells = ABUFFER_FOLLOWS_CELLS && traversal.segment.face != SEGMENT_NEAR;
    state.cursor[7] = in_cells ? bits_of_cell(traversal.searched) : traversal.place;
}

// Restores the segment in which a ray paused.
void abuffer_restore_progress(TraceState state, vec2 clip, out AbufferProgress progress, out vec2 ends, out uint view) {
    uint flags = state.cursor[0];
    view = bits_get(flags, ABUFFER_CURSOR_VIEW);
    ends = vec2(uintBitsToFloat(state.cursor[1]), uintBitsToFloat(state.cursor[2]));
    // A ray that paused in the camera's view has not traversed any face yet.
    bool in_faces = view != ABUFFER_CAMERA && ABUFFER_HAS_CUBE;
    progress = AbufferProgress(bits_get(flags, ABUFFER_CURSOR_STAGE), in_faces ? ends.y : clip.x);
}

// Restores the place of a paused ray in its segment, after the traversal of that segment has begun.
void abuffer_restore(TraceState state, inout AbufferTraversal traversal, out AbufferSearch search) {
    uint flags = state.cursor[0];
    traversal.place = state.cursor[7];
    if (ABUFFER_FOLLOWS_CELLS && traversal.segment.face != SEGMENT_NEAR) {
        traversal.cells.cell = cell_of_bits(state.cursor[3]);
        traversal.cells.t_in = uintBitsToFloat(state.cursor[4]);
        traversal.cells.error_in = uintBitsToFloat(state.cursor[5]);
        traversal.cells.neighbours = bits_get(flags, ABUFFER_CURSOR_NEIGHBOURS);
        traversal.entered = true;
        traversal.resumed = true;
        traversal.searched = cell_of_bits(state.cursor[7]);
    }
    search.in_bucket = bits_are_set(flags, ABUFFER_CURSOR_IN_BUCKET);
    search.in_conservative = bits_are_set(flags, ABUFFER_CURSOR_IN_CONSERVATIVE);
    search.bucket = search.in_bucket ? bits_get(flags, ABUFFER_CURSOR_BUCKET) : 0u;
    search.link = state.cursor[6];
}

// Prepares the search of the cell that the traversal is at. `begun` says that a paused search goes on.
void abuffer_begin_search(AbufferRef s, bool begun, inout AbufferTraversal traversal, inout AbufferSearch search) {
    if (!begun) {
        search.in_bucket = false;
        search.in_conservative = false;
        search.bucket = 0u;
        search.link = 0u;
    }
    if (ABUFFER_FOLLOWS_CELLS) {
        search.t_low = traversal.cells.t_in - traversal.cells.error_in;
        search.t_high = traversal.cells.t_out + traversal.cells.error_out;
    } else {
        samples_cell(traversal.samples, traversal.place, traversal.searched, search.t_low, search.t_high);
    }
    search.view = traversal.segment.face;
    search.place = traversal.searched;
    search.cell = abuffer_cell(s, search.view, search.place);
    vec2 z = traversal.origin.z + vec2(search.t_low, search.t_high) * traversal.direction.z;
    search.z = vec2(min(z.x, z.y), max(z.x, z.y));
    search.rounding = ABUFFER_HEADER(s).rounding
        + 8.0 * FLOAT_ROUNDING * (abs(traversal.origin.z) + max(abs(search.t_low), abs(search.t_high)) * abs(traversal.direction.z));
}

// Moves the traversal to the next cell. Returns false at the end of the segment.
bool abuffer_next_cell(inout AbufferTraversal traversal) {
    if (ABUFFER_FOLLOWS_CELLS) {
        if (march_take_neighbour(traversal.cells, traversal.searched)) {
            return true;
        }
        bool more = march_step(traversal.cells);
        abuffer_enter_cell(traversal);
        return more;
    }
    traversal.place++;
    return traversal.place < traversal.samples.count;
}

#endif

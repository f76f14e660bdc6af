// What: what is kept of a ray that pauses, and how its traversal goes on from there.
// Reads: trace state. Writes: trace state.
// cursor: 0 flags and view, 1 block of the second level, 2 block, 3 cell, 4 place within what is being searched.
#ifndef LDC_PAUSE_GLSL
#define LDC_PAUSE_GLSL

#include "contract/bits.glsl"
#include "ldc/walk.glsl"

// Fields of the flags.
#define LDC_CURSOR_STARTED 0, 1
#define LDC_CURSOR_IN_BLOCK 1, 1
#define LDC_CURSOR_BEGUN 2, 1
#define LDC_CURSOR_IN_FRINGE 3, 1
#define LDC_CURSOR_TURN 4, 2
#define LDC_CURSOR_IN_UPPER 6, 1

// `turn` is that of the view.
void ldc_save(LdcWalk walk, uint turn, LdcSearch search, inout TraceState state) {
    state.cursor[0] = bits_put(true, LDC_CURSOR_STARTED) | bits_put(walk.in_upper, LDC_CURSOR_IN_UPPER)
        | bits_put(walk.in_block, LDC_CURSOR_IN_BLOCK) | bits_put(search.begun, LDC_CURSOR_BEGUN)
        | bits_put(search.in_fringe, LDC_CURSOR_IN_FRINGE) | bits_put(turn, LDC_CURSOR_TURN);
    state.cursor[1] = bits_of_cell(ldc_march_square(walk.flat_ray, walk.upper));
    state.cursor[2] = bits_of_cell(ldc_march_square(walk.flat_ray, walk.blocks));
    state.cursor[3] = bits_of_cell(ldc_march_square(walk.flat_ray, walk.cells));
    state.cursor[4] = search.place;
}

void ldc_restore(TraceState state, inout LdcWalk walk, inout LdcSearch search) {
    uint flags = state.cursor[0];
    vec2 stretch = vec2(walk.t_begin, walk.t_end);
    ivec2 square = ivec2(0);
    bool within = false;
    walk.in_upper = bits_are_set(flags, LDC_CURSOR_IN_UPPER);
    walk.in_block = bits_are_set(flags, LDC_CURSOR_IN_BLOCK);
    // Each traversal has begun before, so it begins.
    if (LDC_SKIP != 0u && LDC_LEVELS == 2u) {
        ldc_begin_level(walk, 1u, false, square, stretch, walk.upper);
        square = cell_of_bits(state.cursor[1]);
        ldc_march_resume(walk.flat_ray, square, walk.upper);
        stretch = ldc_block_stretch(walk, 1u, square);
        within = true;
    }
    if (LDC_SKIP != 0u && walk.in_upper) {
        ldc_begin_level(walk, 0u, within, square, stretch, walk.blocks);
        square = cell_of_bits(state.cursor[2]);
        ldc_march_resume(walk.flat_ray, square, walk.blocks);
        stretch = ldc_block_stretch(walk, 0u, square);
        within = true;
    }
    if (walk.in_block) {
        ldc_begin_level(walk, 2u, within, square, stretch, walk.cells);
        ldc_march_resume(walk.flat_ray, cell_of_bits(state.cursor[3]), walk.cells);
    }
    search.begun = bits_are_set(flags, LDC_CURSOR_BEGUN);
    search.in_fringe = bits_are_set(flags, LDC_CURSOR_IN_FRINGE);
    search.place = state.cursor[4];
}

#endif

// Saves the state of a ray that pauses, and resumes its traversal from it.
// Reads: trace state, header. Writes: trace state.
// Words of the cursor: 0 flags and view; 1 block of the second level; 2 block of the first level; 3 cell; 4
// place within the list that is being searched.
#ifndef LDC_PAUSE_GLSL
#define LDC_PAUSE_GLSL

#include "contract/bits.glsl"
#include "ldc/traversal.glsl"

// Fields of the flags: first bit and width (contract/bits.glsl).
#define LDC_CURSOR_STARTED 0, 1
#define LDC_CURSOR_IN_BLOCK 1, 1
#define LDC_CURSOR_BEGUN 2, 1
#define LDC_CURSOR_IN_CONSERVATIVE 3, 1
#define LDC_CURSOR_TURN 4, 2
#define LDC_CURSOR_IN_UPPER 6, 1

// Saves the state of a ray. `turn` is the number of the view in the ray's order of views.
void ldc_save(LdcTraversal traversal, uint turn, LdcSearch search, inout TraceState state) {
    state.cursor[0] = bits_put(true, LDC_CURSOR_STARTED) | bits_put(traversal.in_upper, LDC_CURSOR_IN_UPPER)
        | bits_put(traversal.in_block, LDC_CURSOR_IN_BLOCK) | bits_put(search.begun, LDC_CURSOR_BEGUN)
        | bits_put(search.in_conservative, LDC_CURSOR_IN_CONSERVATIVE) | bits_put(turn, LDC_CURSOR_TURN);
    state.cursor[1] = bits_of_cell(ldc_march_square(traversal.flat_ray, traversal.upper));
    state.cursor[2] = bits_of_cell(ldc_march_square(traversal.flat_ray, traversal.blocks));
    state.cursor[3] = bits_of_cell(ldc_march_square(traversal.flat_ray, traversal.cells));
    state.cursor[4] = search.place;
}

// Restores the state of a ray in a view whose traversal has begun.
void ldc_restore(TraceState state, inout LdcTraversal traversal, inout LdcSearch search) {
    uint flags = state.cursor[0];
    vec2 interval = vec2(traversal.t_begin, traversal.t_end);
    ivec2 square = ivec2(0);
    bool within = false;
    traversal.in_upper = bits_are_set(flags, LDC_CURSOR_IN_UPPER);
    traversal.in_block = bits_are_set(flags, LDC_CURSOR_IN_BLOCK);
    // Each of these traversals was begun before the pause, so none of them is empty.
    if (LDC_SKIP != 0u && LDC_LEVELS == 2u) {
        ldc_begin_level(traversal, 1u, false, square, interval, traversal.upper);
        square = cell_of_bits(state.cursor[1]);
        ldc_march_resume(traversal.flat_ray, square, traversal.upper);
        interval = ldc_block_interval(traversal, 1u, square);
        within = true;
    }
    if (LDC_SKIP != 0u && traversal.in_upper) {
        ldc_begin_level(traversal, 0u, within, square, interval, traversal.blocks);
        square = cell_of_bits(state.cursor[2]);
        ldc_march_resume(traversal.flat_ray, square, traversal.blocks);
        interval = ldc_block_interval(traversal, 0u, square);
        within = true;
    }
    if (traversal.in_block) {
        ldc_begin_level(traversal, 2u, within, square, interval, traversal.cells);
        ldc_march_resume(traversal.flat_ray, cell_of_bits(state.cursor[3]), traversal.cells);
    }
    search.begun = bits_are_set(flags, LDC_CURSOR_BEGUN);
    search.in_conservative = bits_are_set(flags, LDC_CURSOR_IN_CONSERVATIVE);
    search.place = state.cursor[4];
}

#endif

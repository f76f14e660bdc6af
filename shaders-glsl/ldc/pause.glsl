// What: what is kept of a ray that pauses, and how its traversal goes on from there.
// Reads: trace state. Writes: trace state.
// cursor: 0 flags and view, 1 block of the second level, 2 block, 3 cell, 4 place within what is being searched.
#ifndef LDC_PAUSE_GLSL
#define LDC_PAUSE_GLSL

#include "ldc/walk.glsl"

#define LDC_CURSOR_STARTED 1u
#define LDC_CURSOR_IN_BLOCK 2u
#define LDC_CURSOR_BEGUN 4u
#define LDC_CURSOR_IN_FRINGE 8u
#define LDC_CURSOR_IN_UPPER 64u

// Bits 4 and 5 of the flags are the turn of the view.
void ldc_save(LdcWalk walk, uint turn, LdcSearch search, inout TraceState state) {
    state.cursor[0] = LDC_CURSOR_STARTED | (walk.in_upper ? LDC_CURSOR_IN_UPPER : 0u)
        | (walk.in_block ? LDC_CURSOR_IN_BLOCK : 0u) | (search.begun ? LDC_CURSOR_BEGUN : 0u)
        | (search.in_fringe ? LDC_CURSOR_IN_FRINGE : 0u) | turn << 4;
    state.cursor[1] = ldc_march_pack(ldc_march_square(walk.flat_ray, walk.upper));
    state.cursor[2] = ldc_march_pack(ldc_march_square(walk.flat_ray, walk.blocks));
    state.cursor[3] = ldc_march_pack(ldc_march_square(walk.flat_ray, walk.cells));
    state.cursor[4] = search.place;
}

void ldc_restore(TraceState state, inout LdcWalk walk, inout LdcSearch search) {
    uint flags = state.cursor[0];
    vec2 stretch = vec2(walk.t_begin, walk.t_end);
    ivec2 square = ivec2(0);
    bool within = false;
    walk.in_upper = (flags & LDC_CURSOR_IN_UPPER) != 0u;
    walk.in_block = (flags & LDC_CURSOR_IN_BLOCK) != 0u;
    // Each traversal has begun before, so it begins.
    if (LDC_SKIP != 0u && LDC_LEVELS == 2u) {
        ldc_begin_level(walk, 1u, false, square, stretch, walk.upper);
        square = ldc_march_unpack(state.cursor[1]);
        ldc_march_resume(walk.flat_ray, square, walk.upper);
        stretch = ldc_block_stretch(walk, 1u, square);
        within = true;
    }
    if (LDC_SKIP != 0u && walk.in_upper) {
        ldc_begin_level(walk, 0u, within, square, stretch, walk.blocks);
        square = ldc_march_unpack(state.cursor[2]);
        ldc_march_resume(walk.flat_ray, square, walk.blocks);
        stretch = ldc_block_stretch(walk, 0u, square);
        within = true;
    }
    if (walk.in_block) {
        ldc_begin_level(walk, 2u, within, square, stretch, walk.cells);
        ldc_march_resume(walk.flat_ray, ldc_march_unpack(state.cursor[3]), walk.cells);
    }
    search.begun = (flags & LDC_CURSOR_BEGUN) != 0u;
    search.in_fringe = (flags & LDC_CURSOR_IN_FRINGE) != 0u;
    search.place = state.cursor[4];
}

#endif

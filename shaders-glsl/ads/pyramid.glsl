// A pyramid of depth bounds over the cells of views: blocks of 2x2 cells, 4x4 cells and so on, up to one
// block per view. The levels follow one another in the words of a pool.
// Reads, writes: nothing.
// Source: DIRT sections 4.1.1 and 4.2.1. Here the bounds of a block also hold those of the cells around it,
// so that no cell is skipped that the march would have touched within rounding.
// The pass that builds a pyramid (ads/build_pyramid.comp) includes structure/pyramid.glsl, which defines,
// with the prefix of the structure in place of x:
//   PyramidLevel x_pyramid_first(XRef s, uint view)       level 1 of the views that are built together,
//                                                         of which `view` is the first
//   uint x_pyramid_cells(XRef s, uint view)               cells along a side of these views, border included
//   uvec2 x_pyramid_cell(XRef s, uint view, ivec2 cell)   words of a cell
//   uvec2 x_pyramid_read(XRef s, uint word)               words of a block
//   void x_pyramid_write(XRef s, uint word, uvec2 words)
#ifndef ADS_PYRAMID_GLSL
#define ADS_PYRAMID_GLSL

// Number of words of a block: the complement of the bits of the smallest depth, and the bits of the largest
// depth. Both words are 0 if the block is empty.
#define PYRAMID_WORDS 2u

// Level k of a pyramid. Its blocks have 2^k cells along a side, counted from the border on.
struct PyramidLevel {
    uint level;           // number of the level, k
    uint side;            // blocks along a side of a view
    uint views;           // number of views
    uint base;            // word of the level's first block
};

// Returns level 1 of a pyramid over views with `cells` cells along a side, border included.
PyramidLevel pyramid_first(uint cells, uint views, uint base) {
    return PyramidLevel(1u, (cells + 1u) >> 1, views, base);
}

PyramidLevel pyramid_above(PyramidLevel below) {
    uint words = PYRAMID_WORDS * below.views * below.side * below.side;
    return PyramidLevel(below.level + 1u, (below.side + 1u) >> 1, below.views, below.base + words);
}

// Returns the level below a level of a pyramid over views with `cells` cells along a side. There is none
// below level 1.
PyramidLevel pyramid_below(PyramidLevel above, uint cells) {
    uint level = above.level - 1u;
    uint side = (cells + (1u << level) - 1u) >> level;
    return PyramidLevel(level, side, above.views, above.base - PYRAMID_WORDS * above.views * side * side);
}

// Returns the level that has one block per view.
PyramidLevel pyramid_top(PyramidLevel level) {
    while (level.side > 1u) {
        level = pyramid_above(level);
    }
    return level;
}

// Returns the word behind the last level.
uint pyramid_end(PyramidLevel level) {
    level = pyramid_top(level);
    return level.base + PYRAMID_WORDS * level.views;
}

uint pyramid_word(PyramidLevel level, uint view, uvec2 block) {
    return level.base + PYRAMID_WORDS * ((view * level.side + block.y) * level.side + block.x);
}

// Returns the block that contains a cell.
uvec2 pyramid_block(PyramidLevel level, ivec2 cell) {
    return uvec2(cell + 1) >> level.level;
}

// True if a block with these words holds nothing at depths from depths.x to depths.y. NaN gives false, since
// comparisons with NaN are false.
bool pyramid_leaves_out(uvec2 words, vec2 depths) {
    return words.y == 0u || depths.y < uintBitsToFloat(~words.x) || depths.x > uintBitsToFloat(words.y);
}

#endif

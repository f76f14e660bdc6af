// A pyramid of depth bounds over the cells of views: blocks of 2x2, 4x4 ... cells, level behind level
// in the words of a pool, up to one block per view. The pass that builds it includes structure/pyramid.glsl, which
// defines, with the structure's prefix,
//   PyramidLevel x_pyramid_first(XRef s, uint view)            level 1 of the views that are drawn with `view`, the first of them
//   uint x_pyramid_cells(XRef s, uint view)                    cells along a side of those, border included
//   uvec2 x_pyramid_cell(XRef s, uint view, ivec2 cell)        words of a cell
//   uvec2 x_pyramid_read(XRef s, uint word)                    words of a block
//   void x_pyramid_write(XRef s, uint word, uvec2 words)
// Reads, writes: nothing.
// Source: DIRT sections 4.1.1 and 4.2.1. Here the bounds of a block are also those of the cells around it, so that no
// cell is skipped that the march would have touched within rounding.
#ifndef ADS_PYRAMID_GLSL
#define ADS_PYRAMID_GLSL

// Number of words of a block: the complement of the smallest depth's bits, and the bits of the largest; both
// are 0 if the block is empty.
#define PYRAMID_WORDS 2u

// Level k of a pyramid, whose blocks have 2^k cells along a side, the border included.
struct PyramidLevel {
    uint level;
    uint side;            // blocks along a side of a view
    uint views;
    uint base;            // word of its first block
};

// Returns level 1 over views of `cells` cells along a side, border included.
PyramidLevel pyramid_first(uint cells, uint views, uint base) {
    return PyramidLevel(1u, (cells + 1u) >> 1, views, base);
}

PyramidLevel pyramid_above(PyramidLevel below) {
    uint words = PYRAMID_WORDS * below.views * below.side * below.side;
    return PyramidLevel(below.level + 1u, (below.side + 1u) >> 1, below.views, below.base + words);
}

// Returns the level below, of a pyramid over views of `cells` cells along a side; level 1 has none.
PyramidLevel pyramid_below(PyramidLevel above, uint cells) {
    uint level = above.level - 1u;
    uint side = (cells + (1u << level) - 1u) >> level;
    return PyramidLevel(level, side, above.views, above.base - PYRAMID_WORDS * above.views * side * side);
}

// Returns the level with one block per view.
PyramidLevel pyramid_top(PyramidLevel level) {
    while (level.side > 1u) {
        level = pyramid_above(level);
    }
    return level;
}

// Returns the word behind all levels.
uint pyramid_end(PyramidLevel level) {
    level = pyramid_top(level);
    return level.base + PYRAMID_WORDS * level.views;
}

uint pyramid_word(PyramidLevel level, uint view, uvec2 block) {
    return level.base + PYRAMID_WORDS * ((view * level.side + block.y) * level.side + block.x);
}

// Returns the block around a cell.
uvec2 pyramid_block(PyramidLevel level, ivec2 cell) {
    return uvec2(cell + 1) >> level.level;
}

// True if a block with these words holds nothing from depths.x to depths.y. It is false for NaN, since
// comparisons with NaN are false.
bool pyramid_leaves_out(uvec2 words, vec2 depths) {
    return words.y == 0u || depths.y < uintBitsToFloat(~words.x) || depths.x > uintBitsToFloat(words.y);
}

#endif

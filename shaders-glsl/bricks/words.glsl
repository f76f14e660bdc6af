// What: the position of cells in bricks of 4x4x4, and the words of a brick.
// Reads, writes: nothing.
// A cell is (column, row, slice) of a view. A brick has a mask of 64 bits, one per cell that lists something,
// in two words, and a word of its own: for a brick that lists something the number of such cells in all bricks
// before it, for an empty one the number of further bricks that are empty too, towards each of eight octants.
#ifndef BRICKS_WORDS_GLSL
#define BRICKS_WORDS_GLSL

#include "bricks/constants.glsl"

// Bricks of one view with these numbers of columns, rows and slices, each a multiple of 4.
uint brick_count(uvec3 cells) {
    return (cells.x >> 2) * (cells.y >> 2) * (cells.z >> 2);
}

// Running index of the brick of a cell over all views.
uint brick_index(uint view, ivec3 cell, uvec3 cells) {
    uvec3 brick = uvec3(cell) >> 2;
    uvec3 bricks = cells >> 2;
    return ((view * bricks.y + brick.y) * bricks.x + brick.x) * bricks.z + brick.z;
}

// Which of the two words of the mask holds a cell's bit, and which bit that is.
uint brick_word(ivec3 cell) {
    return uint(cell.z >> 1) & 1u;
}

uint brick_bit(ivec3 cell) {
    return uint((cell.x & 3) | (cell.y & 3) << 2 | (cell.z & 1) << 4);
}

// Bits of the 2x2x2 cells around a cell, in the word of its bit.
uint brick_octet(ivec3 cell) {
    return 0x00330033u << uint((cell.x & 2) | (cell.y & 2) << 2);
}

// The octant towards which a ray steps; each of its three directions is up or down.
uint brick_octant(bvec3 up) {
    return (up.z ? 1u : 0u) | (up.x ? 2u : 0u) | (up.y ? 4u : 0u);
}

bool brick_is_empty(uint word) {
    return (word & BRICK_EMPTY) != 0u;
}

// Bricks beyond an empty one, along each axis towards an octant, that are empty too: 0 to 7.
int brick_distance(uint word, uint octant) {
    return int(word >> (3u * octant) & 7u);
}

#endif

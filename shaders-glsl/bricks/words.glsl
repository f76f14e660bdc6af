// The position of cells in bricks of 4x4x4, and the words of a brick.
// Reads, writes: nothing.
// A cell is (column, row, slice) of a view. A brick has a mask of 64 bits, one per cell that lists something,
// in two words, and a word of its own: for a brick that lists something the number of its first list, for an empty
// one of a view the number of further bricks that are empty too, towards each of eight octants. Where cells may be
// divided, a brick also has a mask of those that are, the number of the first of their bricks, and two words: the brick's
// position where it is below the first level; for an empty brick of a view, the first of them says how far its layer
// is empty.
// The list or the brick of a cell is found by counting the bits below its own.
#ifndef BRICKS_WORDS_GLSL
#define BRICKS_WORDS_GLSL

#include "bricks/types.glsl"

// Number of words of a brick.
const uint BRICKS_STRIDE = BRICKS_DEPTH == 0u ? 3u : 8u;

// Returns the number of bricks of one view with these numbers of columns, rows and slices, each a multiple of
// 4.
uint bricks_count(uvec3 cells) {
    return (cells.x >> 2) * (cells.y >> 2) * (cells.z >> 2);
}

// Returns the running index of the brick of a cell over all views.
uint bricks_index(uint view, ivec3 cell, uvec3 cells) {
    uvec3 brick = uvec3(cell) >> 2;
    uvec3 bricks = cells >> 2;
    return ((view * bricks.y + brick.y) * bricks.x + brick.x) * bricks.z + brick.z;
}

// Returns the place within its view of the brick with that index, in bricks.
uvec3 bricks_place(uint brick, uvec3 cells) {
    uvec3 bricks = cells >> 2;
    uint line = brick / bricks.z;
    return uvec3(line % bricks.x, line / bricks.x % bricks.y, brick % bricks.z);
}

// These functions return the index of the word of a brick, of the two words of its masks, and of the words
// that only bricks have whose cells may be divided.
uint bricks_at(uint brick) {
    return BRICKS_STRIDE * brick;
}

uint bricks_mask_at(uint brick, uint word) {
    return BRICKS_STRIDE * brick + 1u + word;
}

uint bricks_divided_at(uint brick, uint word) {
    return BRICKS_STRIDE * brick + 3u + word;
}

uint bricks_child_at(uint brick) {
    return BRICKS_STRIDE * brick + 5u;
}

uint bricks_place_at(uint brick) {
    return BRICKS_STRIDE * brick + 6u;
}

// Returns the index of the word of an empty brick of a view that tells how far its layer of columns and
// slices is empty.
uint bricks_layer_at(uint brick) {
    return BRICKS_STRIDE * brick + 6u;
}

// These functions return which of the mask's two words holds a cell's bit, and the number of that bit.
uint bricks_word(ivec3 cell) {
    return uint(cell.z >> 1) & 1u;
}

uint bricks_bit(ivec3 cell) {
    return uint((cell.x & 3) | (cell.y & 3) << 2 | (cell.z & 1) << 4);
}

// Returns the cell of a bit, within its brick.
ivec3 bricks_cell_of_bit(uint word, uint bit) {
    return ivec3(bit & 3u, bit >> 2 & 3u, bit >> 4 | word << 1);
}

// Returns the bits of the 2x2x2 cells around a cell, in the word of its bit.
uint bricks_octet(ivec3 cell) {
    return 0x00330033u << uint((cell.x & 2) | (cell.y & 2) << 2);
}

// Returns the bits of the cells of a brick between two cells.
uvec2 bricks_cells_between(ivec3 first, ivec3 last) {
    uint column = (2u << last.x) - (1u << first.x);
    uint rows = 0x1111u & (16u << 4 * last.y) - (1u << 4 * first.y);
    uint slice = column * rows;
    uvec4 slices = mix(uvec4(0u), uvec4(slice), bvec4(first.z <= 0, first.z <= 1 && last.z >= 1, first.z <= 2 && last.z >= 2, last.z >= 3));
    return uvec2(slices.x | slices.y << 16, slices.z | slices.w << 16);
}

// Finds the first and last of the empty cells of a brick that a ray crosses in one step from an empty one,
// all of them within the brick: 2x2x2 if those are empty, and up to the end of the brick if all cells ahead
// are empty, one axis after another. `mask` has the bits of cells that are not empty.
void bricks_empty_cells(uvec2 mask, ivec3 cell, bvec3 up, out ivec3 first, out ivec3 last) {
    bool around = (mask[bricks_word(cell)] & bricks_octet(cell)) == 0u;
    first = around ? cell & ~1 : cell;
    last = around ? cell | 1 : cell;
    for (int axis = 0; axis < 3; axis++) {
        ivec3 from = first;
        ivec3 to = last;
        from[axis] = up[axis] ? from[axis] : 0;
        to[axis] = up[axis] ? 3 : to[axis];
        uvec2 hidden = mask & bricks_cells_between(from, to);
        if ((hidden.x | hidden.y) == 0u) {
            first = from;
            last = to;
        }
    }
}

// Returns the bits of the cells of a column of a brick, from its first slice to its last.
uvec2 bricks_column_bits(uvec2 column, uint first, uint last) {
    uint bit = (column.x & 3u) | (column.y & 3u) << 2;
    uvec2 bits = uvec2(0u);
    for (uint slice = first; slice <= last; slice++) {
        uint cell = 1u << (bit + 16u * (slice & 1u));
        bits |= slice < 2u ? uvec2(cell, 0u) : uvec2(0u, cell);
    }
    return bits;
}

// Takes the lowest cell out of a mask; false if the mask was empty.
bool bricks_take_cell(inout uvec2 mask, out uint word, out uint bit) {
    word = mask.x != 0u ? 0u : 1u;
    bit = uint(findLSB(mask[word]));
    bool any_left = mask[word] != 0u;
    mask[word] &= mask[word] - 1u;
    return any_left;
}

// Returns the number of bits of a mask below that one.
uint bricks_rank(uvec2 mask, uint word, uint bit) {
    uint below = (1u << bit) - 1u;
    return uint(word != 0u ? bitCount(mask.x) + bitCount(mask.y & below) : bitCount(mask.x & below));
}

// Returns the octant towards which a ray steps; each of its three directions is up or down.
uint bricks_octant(bvec3 up) {
    return (up.z ? 1u : 0u) | (up.x ? 2u : 0u) | (up.y ? 4u : 0u);
}

bool bricks_is_empty(uint word) {
    return (word & BRICKS_EMPTY) != 0u;
}

// Returns the number of bricks beyond an empty one, along each axis towards an octant, that are empty too: 0
// to 7.
int bricks_distance(uint word, uint octant) {
    return int(word >> (3u * octant) & 7u);
}

// Returns the number of bricks beyond an empty one, along columns and slices towards an octant, that are
// empty too in its own row.
int bricks_layer_distance(uint word, uint octant) {
    return int(word >> (4u * (octant & 3u)) & 15u) - 1;
}

#endif

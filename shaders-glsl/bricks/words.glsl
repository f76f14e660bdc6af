// The words of a brick of 4x4x4 cells, and the positions of cells and bricks.
// Reads, writes: nothing.
// A cell of a view has a column, a row and a slice. A brick has a word of its own and a mask of 64 bits, in
// two words, with a bit for each cell that has a list. If any cell has a list, the word is the number of the
// brick's first list. If the brick is an empty one of a view, the word says for each of eight octants how
// many further bricks towards it are empty, too.
// If cells may be divided, a brick has five more words: a mask of its divided cells, in two words; the number
// of the first brick of these cells; and two words that hold the position of a brick below level 0. For an
// empty brick of a view the first of these two says how far its layer of columns and slices is empty.
// The list or the brick of a cell is found by counting the bits of the mask below the cell's bit.
#ifndef BRICKS_WORDS_GLSL
#define BRICKS_WORDS_GLSL

#include "bricks/types.glsl"

// Number of words of a brick.
const uint BRICKS_STRIDE = BRICKS_DEPTH == 0u ? 3u : 8u;

// Returns the number of bricks of a view with these numbers of columns, rows and slices, each a multiple of
// 4.
uint bricks_count(uvec3 cells) {
    return (cells.x >> 2) * (cells.y >> 2) * (cells.z >> 2);
}

// Returns the index of the brick of a cell among the bricks of all views.
uint bricks_index(uint view, ivec3 cell, uvec3 cells) {
    uvec3 brick = uvec3(cell) >> 2;
    uvec3 bricks = cells >> 2;
    return ((view * bricks.y + brick.y) * bricks.x + brick.x) * bricks.z + brick.z;
}

// Returns the position within its view of the brick with an index, in bricks.
uvec3 bricks_place(uint brick, uvec3 cells) {
    uvec3 bricks = cells >> 2;
    uint line = brick / bricks.z;
    return uvec3(line % bricks.x, line / bricks.x % bricks.y, brick % bricks.z);
}

// The next functions return the index of a word of a brick: its own word, the two words of its mask and, if
// cells may be divided, the two words of the mask of divided cells, the word of its first child, and the
// first word of its position.
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

// Returns the index of the word that says how far the layer of columns and slices of an empty brick of a view
// is empty.
uint bricks_layer_at(uint brick) {
    return BRICKS_STRIDE * brick + 6u;
}

// The next two functions return which of the two words of a mask holds the bit of a cell, and the number of
// the bit.
uint bricks_word(ivec3 cell) {
    return uint(cell.z >> 1) & 1u;
}

uint bricks_bit(ivec3 cell) {
    return uint((cell.x & 3) | (cell.y & 3) << 2 | (cell.z & 1) << 4);
}

// Returns the cell of a bit, as a position within its brick.
ivec3 bricks_cell_of_bit(uint word, uint bit) {
    return ivec3(bit & 3u, bit >> 2 & 3u, bit >> 4 | word << 1);
}

// Returns the bits of the 2x2x2 cells that contain a cell, in the word that holds the cell's bit.
uint bricks_octet(ivec3 cell) {
    return 0x00330033u << uint((cell.x & 2) | (cell.y & 2) << 2);
}

// Returns the bits of the cells of a brick from `first` to `last` along each axis.
uvec2 bricks_cells_between(ivec3 first, ivec3 last) {
    uint column = (2u << last.x) - (1u << first.x);
    uint rows = 0x1111u & (16u << 4 * last.y) - (1u << 4 * first.y);
    uint slice = column * rows;
    uvec4 slices = mix(uvec4(0u), uvec4(slice), bvec4(first.z <= 0, first.z <= 1 && last.z >= 1, first.z <= 2 && last.z >= 2, last.z >= 3));
    return uvec2(slices.x | slices.y << 16, slices.z | slices.w << 16);
}

// Finds the box of empty cells of a brick that a ray crosses in one step from an empty cell. The box is the
// 2x2x2 cells around the cell if these are empty. Then it is extended to the end of the brick, one axis after
// the other, if all cells that this adds are empty. `mask` has the bits of cells that are not empty.
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

// Returns the bits of the cells of a column of a brick, from slice `first` to slice `last`.
uvec2 bricks_column_bits(uvec2 column, uint first, uint last) {
    uint bit = (column.x & 3u) | (column.y & 3u) << 2;
    uvec2 bits = uvec2(0u);
    for (uint slice = first; slice <= last; slice++) {
        uint cell = 1u << (bit + 16u * (slice & 1u));
        bits |= slice < 2u ? uvec2(cell, 0u) : uvec2(0u, cell);
    }
    return bits;
}

// Takes the lowest bit out of a mask, and gives the word and the bit; returns false if the mask is empty.
bool bricks_take_cell(inout uvec2 mask, out uint word, out uint bit) {
    word = mask.x != 0u ? 0u : 1u;
    bit = uint(findLSB(mask[word]));
    bool any_left = mask[word] != 0u;
    mask[word] &= mask[word] - 1u;
    return any_left;
}

// Returns the number of bits of a mask below a bit.
uint bricks_rank(uvec2 mask, uint word, uint bit) {
    uint below = (1u << bit) - 1u;
    return uint(word != 0u ? bitCount(mask.x) + bitCount(mask.y & below) : bitCount(mask.x & below));
}

// Returns the octant towards which a ray goes: whether it goes up along slices, columns and rows.
uint bricks_octant(bvec3 up) {
    return (up.z ? 1u : 0u) | (up.x ? 2u : 0u) | (up.y ? 4u : 0u);
}

bool bricks_is_empty(uint word) {
    return (word & BRICKS_EMPTY) != 0u;
}

// Returns how many bricks beyond an empty one are empty, too, along all axes towards an octant: 0 to 7.
int bricks_distance(uint word, uint octant) {
    return int(word >> (3u * octant) & 7u);
}

// Returns how many bricks beyond an empty one are empty, too, along columns and slices towards an octant,
// within the brick's own row of bricks.
int bricks_layer_distance(uint word, uint octant) {
    return int(word >> (4u * (octant & 3u)) & 15u) - 1;
}

#endif

// Packs several small numbers into one 32-bit word, and reads them back.
// Reads, writes: nothing.
// A field of a word is a macro that expands to two arguments of the functions below, the field's first bit
// and its width in bits: `#define X_CURSOR_VIEW 2, 3`.
#ifndef CONTRACT_BITS_GLSL
#define CONTRACT_BITS_GLSL

// Returns a word with a number in one field and zeros elsewhere. Bits of the number that do not fit the field
// are dropped, so that no field changes another.
uint bits_put(uint number, int first, int width) {
    return (number & ((1u << width) - 1u)) << first;
}

uint bits_put(bool flag, int first, int width) {
    return flag ? 1u << first : 0u;
}

// Returns the number in a field of a word.
uint bits_get(uint word, int first, int width) {
    return word >> first & ((1u << width) - 1u);
}

// True if the number in a field is not zero.
bool bits_are_set(uint word, int first, int width) {
    return bits_get(word, first, width) != 0u;
}

// Packs a cell of a view: column and row, each from -32,768 to 32,767, in 16 bits.
uint bits_of_cell(ivec2 cell) {
    return (uint(cell.x) & 0xFFFFu) | uint(cell.y) << 16;
}

ivec2 cell_of_bits(uint word) {
    return ivec2(int(word << 16) >> 16, int(word) >> 16);
}

// Packs a cell of a grid that has at most 1,024 cells along each axis, in 10 bits per axis.
uint bits_of_grid_cell(ivec3 cell) {
    return uint(cell.x) | uint(cell.y) << 10 | uint(cell.z) << 20;
}

ivec3 grid_cell_of_bits(uint word) {
    return ivec3(word & 1023u, word >> 10 & 1023u, word >> 20);
}

#endif

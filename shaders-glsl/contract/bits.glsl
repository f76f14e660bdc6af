// Small numbers in the bits of one word. A field is a name for its first bit and its width, which stand as two
// arguments in the calls below: `#define X_CURSOR_VIEW 2, 3`.
// Reads, writes: nothing.
#ifndef CONTRACT_BITS_GLSL
#define CONTRACT_BITS_GLSL

// The word with a number in its field and zeros elsewhere. Bits of the number beyond the field are dropped, so that no
// field reaches into another one.
uint bits_put(uint number, int first, int width) {
    return (number & ((1u << width) - 1u)) << first;
}

uint bits_put(bool flag, int first, int width) {
    return flag ? 1u << first : 0u;
}

// The number in a field of a word.
uint bits_get(uint word, int first, int width) {
    return word >> first & ((1u << width) - 1u);
}

// True if a field holds anything but zero.
bool bits_are_set(uint word, int first, int width) {
    return bits_get(word, first, width) != 0u;
}

// A column and a row from -32,768 to 32,767.
uint bits_of_cell(ivec2 cell) {
    return (uint(cell.x) & 0xFFFFu) | uint(cell.y) << 16;
}

ivec2 cell_of_bits(uint word) {
    return ivec2(int(word << 16) >> 16, int(word) >> 16);
}

// A cell of a grid with at most 1,024 along a side.
uint bits_of_grid_cell(ivec3 cell) {
    return uint(cell.x) | uint(cell.y) << 10 | uint(cell.z) << 20;
}

ivec3 grid_cell_of_bits(uint word) {
    return ivec3(word & 1023u, word >> 10 & 1023u, word >> 20);
}

#endif

// What: the pools of primitive lists that are kept in bricks, beside those of primitive/accessors.glsl.
// Reads, writes: bricks, distances, records, triangles; lists hold where the list of each cell that has one ends.
#ifndef PRIMITIVE_BRICK_ACCESSORS_GLSL
#define PRIMITIVE_BRICK_ACCESSORS_GLSL

#include "primitive/accessors.glsl"
#include "ads/bricks.glsl"
#include "ads/slices.glsl"

// Where lists keep the bounds of cells, bricks keep three words each: that of ads/bricks.glsl and the two of the mask.
// Distances are found where the sums of scans were.
#define PRIMITIVE_BRICKS(s) PRIMITIVE_BOUNDS(s)
#define PRIMITIVE_DISTANCES(s) PRIMITIVE_SUMS(s)

#ifdef ADDRESSING_ADDRESS
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PrimitiveTriangleAddress { vec3 corners[]; };
#define PRIMITIVE_RECORDS(s) PrimitiveWordAddress(PRIMITIVE_HEADER(s).records_address).words
#define PRIMITIVE_PAIRS(s) PrimitiveWordAddress(PRIMITIVE_HEADER(s).triangles_address).words
#define PRIMITIVE_CORNERS(s) PrimitiveTriangleAddress(PRIMITIVE_HEADER(s).triangles_address).corners
#else
layout(set = STRUCTURE_SET, binding = 6, scalar) buffer PrimitiveRecordsBuffer { uint primitive_record_words[]; };
#ifdef PRIMITIVE_BINNING
layout(set = STRUCTURE_SET, binding = 7, scalar) buffer PrimitivePairsBuffer { uint primitive_pair_words[]; };
#else
layout(set = STRUCTURE_SET, binding = 7, scalar) buffer PrimitiveTrianglesBuffer { vec3 primitive_corners[]; };
#endif
#define PRIMITIVE_RECORDS(s) primitive_record_words
#define PRIMITIVE_PAIRS(s) primitive_pair_words
#define PRIMITIVE_CORNERS(s) primitive_corners
#endif

// A triangle in a column of cells, between two slices.
struct BrickRecord {
    uint primitive;
    uint x;
    uint y;
    uint face;
    uint first;           // slice
    uint last;
};

Slices primitive_slices(PrimitiveRef s) {
    return Slices(int(PRIMITIVE_HEADER(s).slices), PRIMITIVE_HEADER(s).slice_first, PRIMITIVE_HEADER(s).slice_shift);
}

uint primitive_brick_count(PrimitiveRef s) {
    return VIEW_FACES * brick_count(PRIMITIVE_HEADER(s).tiles, PRIMITIVE_HEADER(s).slices);
}

// Cells that list something and whose list fits.
uint primitive_listed_cells(PrimitiveRef s) {
    return min(PRIMITIVE_HEADER(s).cell_demand, PRIMITIVE_HEADER(s).cell_capacity);
}

uint primitive_stored_records(PrimitiveRef s) {
    return min(PRIMITIVE_HEADER(s).record_demand, PRIMITIVE_HEADER(s).record_capacity);
}

// Where the word of a brick stands, and where one of its mask.
uint brick_at(uint brick) {
    return 3u * brick;
}

uint brick_mask_at(uint brick, uint word) {
    return 3u * brick + 1u + word;
}

// Whether a brick lists nothing.
bool brick_has_nothing(PrimitiveRef s, uint brick) {
    return (PRIMITIVE_BRICKS(s)[brick_mask_at(brick, 0u)] | PRIMITIVE_BRICKS(s)[brick_mask_at(brick, 1u)]) == 0u;
}

// Files a record, or counts that there was no room for it.
void brick_file_record(PrimitiveRef s, BrickRecord record) {
    uint place = atomicAdd(PRIMITIVE_HEADER(s).record_demand, 1u);
    if (place < PRIMITIVE_HEADER(s).record_capacity) {
        PRIMITIVE_RECORDS(s)[3u * place] = record.primitive;
        PRIMITIVE_RECORDS(s)[3u * place + 1u] = record.x | record.y << 12 | record.face << 24;
        PRIMITIVE_RECORDS(s)[3u * place + 2u] = record.first | record.last << 16;
    }
}

BrickRecord brick_record(PrimitiveRef s, uint place) {
    uint column = PRIMITIVE_RECORDS(s)[3u * place + 1u];
    uint slices = PRIMITIVE_RECORDS(s)[3u * place + 2u];
    return BrickRecord(PRIMITIVE_RECORDS(s)[3u * place], column & 0xFFFu, column >> 12 & 0xFFFu, column >> 24,
        slices & 0xFFFFu, slices >> 16);
}

// Cells before the one at `bit` of word `word` that list something, in its brick.
uint brick_rank(PrimitiveRef s, uint brick, uint word, uint bit) {
    uint before = uint(bitCount(PRIMITIVE_BRICKS(s)[brick_mask_at(brick, word)] & ((1u << bit) - 1u)));
    return before + (word != 0u ? uint(bitCount(PRIMITIVE_BRICKS(s)[brick_mask_at(brick, 0u)])) : 0u);
}

// The list of a cell that lists something, while the words of bricks are those of the scan.
uint brick_list(PrimitiveRef s, uint face, ivec3 cell, uint tiles, uint slices) {
    uint brick = brick_index(face, cell, tiles, slices);
    return PRIMITIVE_BRICKS(s)[brick_at(brick)] + brick_rank(s, brick, brick_word(cell), brick_bit(cell));
}

#endif

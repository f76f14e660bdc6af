// What: the pools of primitive lists that are kept in bricks, beside those of primitive/accessors.glsl.
// Reads, writes: bricks, distances, records, triangles; lists hold where the list of each cell that has one ends.
#ifndef PRIMITIVE_BRICK_ACCESSORS_GLSL
#define PRIMITIVE_BRICK_ACCESSORS_GLSL

#include "primitive/accessors.glsl"
#include "ads/bricks.glsl"
#include "ads/brick_axes.glsl"
#include "ads/slices.glsl"

// Where lists keep the bounds of cells, bricks keep three words each: that of ads/bricks.glsl and the two of the mask.
// Distances are found where the sums of scans were.
#define PRIMITIVE_BRICKS(s) PRIMITIVE_BOUNDS(s)
#define PRIMITIVE_DISTANCES(s) PRIMITIVE_SUMS(s)

#ifdef ADDRESSING_ADDRESS
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PrimitiveTriangleAddress { vec3 corners[]; };
#define PRIMITIVE_RECORDS(s) PrimitiveWordAddress(PRIMITIVE_HEADER(s).records_address).words
#define PRIMITIVE_CORNERS(s) PrimitiveTriangleAddress(PRIMITIVE_HEADER(s).triangles_address).corners
#else
layout(set = STRUCTURE_SET, binding = 6, scalar) buffer PrimitiveRecordsBuffer { uint primitive_record_words[]; };
layout(set = STRUCTURE_SET, binding = 7, scalar) buffer PrimitiveTrianglesBuffer { vec3 primitive_corners[]; };
#define PRIMITIVE_RECORDS(s) primitive_record_words
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

BrickAxes primitive_axes(PrimitiveRef s) {
    return BrickAxes(PRIMITIVE_HEADER(s).cells_lower, PRIMITIVE_HEADER(s).cells_per_metre, PRIMITIVE_HEADER(s).rounding);
}

// Faces of the cube, or the one view along an axis.
uint primitive_view_count() {
    return PRIMITIVE_VIEWS == PRIMITIVE_VIEWS_AXES ? 1u : VIEW_FACES;
}

// Columns, rows and slices of a view.
uvec3 primitive_cells(PrimitiveRef s) {
    uint columns = PRIMITIVE_HEADER(s).tiles;
    return uvec3(columns, PRIMITIVE_VIEWS == PRIMITIVE_VIEWS_AXES ? PRIMITIVE_HEADER(s).rows : columns, PRIMITIVE_HEADER(s).slices);
}

uint primitive_brick_count(PrimitiveRef s) {
    return primitive_view_count() * brick_count(primitive_cells(s));
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

// Sets the bits of the cells of a record.
void brick_mark(PrimitiveRef s, BrickRecord record) {
    uvec3 cells = primitive_cells(s);
    for (uint slice = record.first & ~1u; slice <= record.last; slice += 2u) {
        ivec3 cell = ivec3(record.x, record.y, slice);
        uint bit = brick_bit(cell);
        uint bits = (slice >= record.first ? 1u << bit : 0u) | (slice < record.last ? 1u << (bit + 16u) : 0u);
        uint brick = brick_index(record.face, cell, cells);
        uint word = brick_mask_at(brick, brick_word(cell));
        // Most bits are set already, and reading is cheaper.
        if ((PRIMITIVE_BRICKS(s)[word] & bits) != bits) {
            atomicOr(PRIMITIVE_BRICKS(s)[word], bits);
        }
    }
}

// Files a record and marks its cells, or counts that there was no room for it.
void brick_file_record(PrimitiveRef s, BrickRecord record) {
    uint place = atomicAdd(PRIMITIVE_HEADER(s).record_demand, 1u);
    if (place < PRIMITIVE_HEADER(s).record_capacity) {
        PRIMITIVE_RECORDS(s)[3u * place] = record.primitive;
        PRIMITIVE_RECORDS(s)[3u * place + 1u] = record.x | record.y << 12 | record.face << 24;
        PRIMITIVE_RECORDS(s)[3u * place + 2u] = record.first | record.last << 16;
        brick_mark(s, record);
    }
}

BrickRecord brick_record(PrimitiveRef s, uint place) {
    uint column = PRIMITIVE_RECORDS(s)[3u * place + 1u];
    uint slices = PRIMITIVE_RECORDS(s)[3u * place + 2u];
    return BrickRecord(PRIMITIVE_RECORDS(s)[3u * place], column & 0xFFFu, column >> 12 & 0xFFFu, column >> 24,
        slices & 0xFFFFu, slices >> 16);
}

// The words of a brick while its own is that of the scan.
struct BrickWords {
    uint before;          // cells that list something in all bricks before
    uvec2 mask;
};

BrickWords brick_words(PrimitiveRef s, uint face, ivec3 cell, uvec3 cells) {
    uint at = brick_at(brick_index(face, cell, cells));
    return BrickWords(PRIMITIVE_BRICKS(s)[at], uvec2(PRIMITIVE_BRICKS(s)[at + 1u], PRIMITIVE_BRICKS(s)[at + 2u]));
}

// The list of a cell of the brick that lists something.
uint brick_list(BrickWords words, ivec3 cell) {
    bool second = brick_word(cell) != 0u;
    uint below = (1u << brick_bit(cell)) - 1u;
    return words.before + uint(second ? bitCount(words.mask.x) + bitCount(words.mask.y & below) : bitCount(words.mask.x & below));
}

#endif

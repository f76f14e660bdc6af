// What: the pools of bricks, and the only place that knows how they are reached: through the descriptors of
// STRUCTURE_SET, or (ADDRESSING_ADDRESS) through the device address of the header.
// Reads, writes: header, bricks, lists, entries, sums or distances, near-region list, records, triangles; lists hold where the
// list of each cell that has one ends.
#ifndef BRICKS_ACCESSORS_GLSL
#define BRICKS_ACCESSORS_GLSL

#include "contract/bits.glsl"
#include "ads/views.glsl"
#include "bricks/header.glsl"
#include "ads/box_cells.glsl"
#include "bricks/slices.glsl"
#include "bricks/words.glsl"

#ifdef ADDRESSING_ADDRESS
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer BrickWordAddress { uint words[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer BrickTriangleAddress { vec3 corners[]; };
#define BRICK_WORDS(s) BrickWordAddress(BRICK_HEADER(s).bricks_address).words
#define BRICK_LISTS(s) BrickWordAddress(BRICK_HEADER(s).lists_address).words
#define BRICK_ENTRIES(s) BrickWordAddress(BRICK_HEADER(s).entries_address).words
#define BRICK_SUMS(s) BrickWordAddress(BRICK_HEADER(s).sums_address).words
#define BRICK_NEAR_LIST(s) BrickWordAddress(BRICK_HEADER(s).near_address).words
#define BRICK_RECORDS(s) BrickWordAddress(BRICK_HEADER(s).records_address).words
#define BRICK_CORNERS(s) BrickTriangleAddress(BRICK_HEADER(s).triangles_address).corners
#else
layout(set = STRUCTURE_SET, binding = 1, scalar) buffer BrickWordsBuffer { uint brick_own_words[]; };
layout(set = STRUCTURE_SET, binding = 2, scalar) buffer BrickListsBuffer { uint brick_list_words[]; };
layout(set = STRUCTURE_SET, binding = 3, scalar) buffer BrickEntriesBuffer { uint brick_entry_words[]; };
layout(set = STRUCTURE_SET, binding = 4, scalar) buffer BrickSumsBuffer { uint brick_sum_words[]; };
layout(set = STRUCTURE_SET, binding = 5, scalar) buffer BrickNearBuffer { uint brick_near_words[]; };
layout(set = STRUCTURE_SET, binding = 6, scalar) buffer BrickRecordsBuffer { uint brick_record_words[]; };
layout(set = STRUCTURE_SET, binding = 7, scalar) buffer BrickTrianglesBuffer { vec3 brick_corners[]; };
#define BRICK_WORDS(s) brick_own_words
#define BRICK_LISTS(s) brick_list_words
#define BRICK_ENTRIES(s) brick_entry_words
#define BRICK_SUMS(s) brick_sum_words
#define BRICK_NEAR_LIST(s) brick_near_words
#define BRICK_RECORDS(s) brick_record_words
#define BRICK_CORNERS(s) brick_corners
#endif

// Distances replace the sums of scans.
#define BRICK_DISTANCES(s) BRICK_SUMS(s)

// Fields of the second and of the third word of a record.
#define BRICK_RECORD_X 0, 12
#define BRICK_RECORD_Y 12, 12
#define BRICK_RECORD_FACE 24, 8
#define BRICK_RECORD_FIRST 0, 16
#define BRICK_RECORD_LAST 16, 16

// A triangle in a column of cells, between two slices.
struct BrickRecord {
    uint primitive;
    uint x;
    uint y;
    uint face;
    uint first;           // slice
    uint last;
};

BrickSlices brick_slices(BrickRef s) {
    return BrickSlices(int(BRICK_HEADER(s).slices), BRICK_HEADER(s).slice_first, BRICK_HEADER(s).slice_shift);
}

BoxCells brick_axes(BrickRef s) {
    return BoxCells(BRICK_HEADER(s).cells_lower, BRICK_HEADER(s).cells_per_metre, BRICK_HEADER(s).rounding);
}

// Faces of the cube, or the one view along an axis.
uint brick_view_count() {
    return BRICK_VIEWS == BRICK_VIEWS_AXES ? 1u : VIEW_FACES;
}

// Columns, rows and slices of a view.
uvec3 brick_cells(BrickRef s) {
    return uvec3(BRICK_HEADER(s).columns, BRICK_HEADER(s).rows, BRICK_HEADER(s).slices);
}

uint brick_total(BrickRef s) {
    return brick_view_count() * brick_count(brick_cells(s));
}

// Cells that list something and whose list fits into the pool.
uint brick_listed_cells(BrickRef s) {
    return min(BRICK_HEADER(s).cell_demand, BRICK_HEADER(s).cell_capacity);
}

uint brick_stored_records(BrickRef s) {
    return min(BRICK_HEADER(s).record_demand, BRICK_HEADER(s).record_capacity);
}

// Index of the word of a brick, and of a word of its mask.
uint brick_at(uint brick) {
    return 3u * brick;
}

uint brick_mask_at(uint brick, uint word) {
    return 3u * brick + 1u + word;
}

// Whether a brick lists nothing.
bool brick_has_nothing(BrickRef s, uint brick) {
    return (BRICK_WORDS(s)[brick_mask_at(brick, 0u)] | BRICK_WORDS(s)[brick_mask_at(brick, 1u)]) == 0u;
}

// Sets the bits of the cells of a record.
void brick_mark(BrickRef s, BrickRecord record) {
    uvec3 cells = brick_cells(s);
    for (uint slice = record.first & ~1u; slice <= record.last; slice += 2u) {
        ivec3 cell = ivec3(record.x, record.y, slice);
        uint bit = brick_bit(cell);
        uint bits = (slice >= record.first ? 1u << bit : 0u) | (slice < record.last ? 1u << (bit + 16u) : 0u);
        uint brick = brick_index(record.face, cell, cells);
        uint word = brick_mask_at(brick, brick_word(cell));
        // Most bits are set already, and reading is cheaper.
        if ((BRICK_WORDS(s)[word] & bits) != bits) {
            atomicOr(BRICK_WORDS(s)[word], bits);
        }
    }
}

// Stores a record and marks its cells, or counts that the capacity did not suffice.
void brick_store_record(BrickRef s, BrickRecord record) {
    uint place = atomicAdd(BRICK_HEADER(s).record_demand, 1u);
    if (place < BRICK_HEADER(s).record_capacity) {
        BRICK_RECORDS(s)[3u * place] = record.primitive;
        BRICK_RECORDS(s)[3u * place + 1u] = bits_put(record.x, BRICK_RECORD_X) | bits_put(record.y, BRICK_RECORD_Y)
            | bits_put(record.face, BRICK_RECORD_FACE);
        BRICK_RECORDS(s)[3u * place + 2u] = bits_put(record.first, BRICK_RECORD_FIRST) | bits_put(record.last, BRICK_RECORD_LAST);
        brick_mark(s, record);
    }
}

BrickRecord brick_record(BrickRef s, uint place) {
    uint column = BRICK_RECORDS(s)[3u * place + 1u];
    uint slices = BRICK_RECORDS(s)[3u * place + 2u];
    return BrickRecord(BRICK_RECORDS(s)[3u * place], bits_get(column, BRICK_RECORD_X), bits_get(column, BRICK_RECORD_Y),
        bits_get(column, BRICK_RECORD_FACE), bits_get(slices, BRICK_RECORD_FIRST), bits_get(slices, BRICK_RECORD_LAST));
}

// The words of a brick, with the number that the scan wrote.
struct BrickWords {
    uint before;          // cells that list something in all bricks before
    uvec2 mask;
};

BrickWords brick_words(BrickRef s, uint face, ivec3 cell, uvec3 cells) {
    uint at = brick_at(brick_index(face, cell, cells));
    return BrickWords(BRICK_WORDS(s)[at], uvec2(BRICK_WORDS(s)[at + 1u], BRICK_WORDS(s)[at + 2u]));
}

// The list of a cell of the brick that lists something.
uint brick_list(BrickWords words, ivec3 cell) {
    bool second = brick_word(cell) != 0u;
    uint below = (1u << brick_bit(cell)) - 1u;
    return words.before + uint(second ? bitCount(words.mask.x) + bitCount(words.mask.y & below) : bitCount(words.mask.x & below));
}

#endif

// The pools of bricks, reached as ads/pools.glsl says.
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

POOL_WORDS(brick, bricks, 1)
POOL_VECTORS(brick, vectors, 1, uvec4, 16)
POOL_WORDS(brick, lists, 2)
POOL_WORDS(brick, entries, 3)
POOL_WORDS(brick, sums, 4)
POOL_WORDS(brick, near, 5)
POOL_WORDS(brick, records, 6)
POOL_RECORDS(brick, corners, 7, vec3)
#define BRICK_POOL(s, pool) POOL_WORDS_OF(brick, pool, BRICK_HEADER(s))
#define BRICK_VECTORS(s) POOL_VIEW_OF(brick, vectors, BRICK_HEADER(s).bricks_address)
#define BRICK_CORNERS(s) POOL_VIEW_OF(brick, corners, BRICK_HEADER(s).triangles_address)

// Number of small triangles of a list, where cells may be divided: those no longer than a cell along any axis.
#define BRICK_SMALL_COUNT(s, list) BRICK_POOL(s, lists)[BRICK_HEADER(s).cell_capacity + (list)]

// Distances replace the sums of scans.
#define BRICK_DISTANCES(s) BRICK_POOL(s, sums)

// Words of a record, and the bit beside the brick's number: the triangle is no longer than a cell along any axis.
#define BRICK_RECORD_WORDS 4u
#define BRICK_RECORD_SMALL 0x80000000u

// The cells of a brick that a triangle reaches into, or some of them.
struct BrickRecord {
    uint primitive;
    uint brick;
    bool small;
    uvec2 cells;          // as bits of a mask
};

BrickSlices brick_slices(BrickRef s) {
    return BrickSlices(int(BRICK_HEADER(s).slices), BRICK_HEADER(s).slice_first, BRICK_HEADER(s).slice_shift);
}

// Number of divisions of cells of a level along each axis.
uvec3 brick_divisions(BrickRef s, uint level) {
    return BRICK_DEPTH == 0u ? uvec3(0u) : min(uvec3(level), BRICK_HEADER(s).depths);
}

// Cells of a level: of the views, or the cells of those divided that often.
BoxCells brick_axes(BrickRef s, uint level) {
    return BoxCells(BRICK_HEADER(s).cells_lower, BRICK_HEADER(s).cells_per_metre * vec3(uvec3(1u) << 2u * brick_divisions(s, level)),
        BRICK_HEADER(s).rounding);
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

// The triangle of an entry of the lists; the entry must be within the pool.
uint brick_entry(BrickRef s, uint entry) {
    return BRICK_POOL(s, entries)[entry];
}

// The triangle at a place of the near-region list.
uint brick_near(BrickRef s, uint place) {
    return BRICK_POOL(s, near)[place];
}

// Cells that list something and whose list fits into the pool.
uint brick_listed_cells(BrickRef s) {
    return min(BRICK_HEADER(s).cell_demand, BRICK_HEADER(s).cell_capacity);
}

uint brick_stored_records(BrickRef s) {
    return min(BRICK_HEADER(s).record_demand, BRICK_HEADER(s).record_capacity);
}

// Bricks that fit into the pool.
uint brick_stored(BrickRef s) {
    return min(BRICK_HEADER(s).brick_demand, BRICK_HEADER(s).brick_capacity);
}

uvec2 brick_mask(BrickRef s, uint brick) {
    return uvec2(BRICK_POOL(s, bricks)[brick_mask_at(brick, 0u)], BRICK_POOL(s, bricks)[brick_mask_at(brick, 1u)]);
}

// The cells of a brick that are divided.
uvec2 brick_divided(BrickRef s, uint brick) {
    return BRICK_DEPTH == 0u ? uvec2(0u)
        : uvec2(BRICK_POOL(s, bricks)[brick_divided_at(brick, 0u)], BRICK_POOL(s, bricks)[brick_divided_at(brick, 1u)]);
}

// Words of a brick that a ray reads.
struct BrickWords {
    uint word;            // its own word
    uvec2 mask;           // cells that list something
    uvec2 divided;        // cells that are divided, as the rest only where cells may be
    uint child;           // the first of their bricks
    uint layer;           // of an empty brick: how far its layer of columns and slices is empty
};

// All of it at once, as whole vectors where cells may be divided.
BrickWords brick_words(BrickRef s, uint brick) {
    if (BRICK_DEPTH == 0u) {
        return BrickWords(BRICK_POOL(s, bricks)[brick_at(brick)], brick_mask(s, brick), uvec2(0u), 0u, 0u);
    }
    uvec4 first = BRICK_VECTORS(s)[2u * brick];
    uvec4 second = BRICK_VECTORS(s)[2u * brick + 1u];
    return BrickWords(first.x, first.yz, uvec2(first.w, second.x), second.y, second.z);
}

// True if a brick of a view lists nothing.
bool brick_has_nothing(BrickRef s, uint brick) {
    uvec2 cells = brick_mask(s, brick) | brick_divided(s, brick);
    return (cells.x | cells.y) == 0u;
}

// Cells of a brick of a level along each axis: 4, or the one that was not divided.
ivec3 brick_side(BrickRef s, uint level) {
    return BRICK_DEPTH == 0u ? ivec3(4) : mix(ivec3(1), ivec3(4), lessThanEqual(uvec3(level), BRICK_HEADER(s).depths));
}

// Where a brick of a level is, in bricks of that level.
uvec3 brick_place_of(BrickRef s, uint brick, uint level) {
    if (level == 0u) {
        return brick_place(brick, brick_cells(s));
    }
    uint at = brick_place_at(brick);
    uint columns = BRICK_POOL(s, bricks)[at];
    return uvec3(columns & 0xFFFFu, columns >> 16, BRICK_POOL(s, bricks)[at + 1u]);
}

// Sets bits of a brick's mask.
void brick_mark(BrickRef s, uint brick, uvec2 cells) {
    for (uint word = 0u; word < 2u; word++) {
        uint at = brick_mask_at(brick, word);
        // Most bits are set already, and reading is cheaper.
        if ((BRICK_POOL(s, bricks)[at] & cells[word]) != cells[word]) {
            atomicOr(BRICK_POOL(s, bricks)[at], cells[word]);
        }
    }
}

// Stores a record of a level and marks its cells, or counts that the capacity did not suffice.
void brick_store_record(BrickRef s, uint level, BrickRecord record) {
    uint place = atomicAdd(BRICK_HEADER(s).record_demand, 1u);
    if (place < BRICK_HEADER(s).record_capacity) {
        BRICK_POOL(s, records)[BRICK_RECORD_WORDS * place] = record.primitive;
        BRICK_POOL(s, records)[BRICK_RECORD_WORDS * place + 1u] = record.brick | (record.small ? BRICK_RECORD_SMALL : 0u);
        BRICK_POOL(s, records)[BRICK_RECORD_WORDS * place + 2u] = record.cells.x;
        BRICK_POOL(s, records)[BRICK_RECORD_WORDS * place + 3u] = record.cells.y;
        brick_mark(s, record.brick, record.cells);
        uint of_level = place - BRICK_HEADER(s).record_first[level];
        if (of_level % BRICK_GROUP_SIZE == 0u) {
            atomicMax(BRICK_HEADER(s).record_groups[3u * level], min(of_level / BRICK_GROUP_SIZE + 1u, BRICK_GROUPS_MOST));
        }
    }
}

void brick_set_cells(BrickRef s, uint place, uvec2 cells) {
    BRICK_POOL(s, records)[BRICK_RECORD_WORDS * place + 2u] = cells.x;
    BRICK_POOL(s, records)[BRICK_RECORD_WORDS * place + 3u] = cells.y;
}

BrickRecord brick_record(BrickRef s, uint place) {
    uint brick = BRICK_POOL(s, records)[BRICK_RECORD_WORDS * place + 1u];
    return BrickRecord(BRICK_POOL(s, records)[BRICK_RECORD_WORDS * place], brick & ~BRICK_RECORD_SMALL, (brick & BRICK_RECORD_SMALL) != 0u,
        uvec2(BRICK_POOL(s, records)[BRICK_RECORD_WORDS * place + 2u], BRICK_POOL(s, records)[BRICK_RECORD_WORDS * place + 3u]));
}

#endif

// Access to the pools of bricks: bricks, lists, entries, records and copied triangles.
// Reads, writes: header, bricks, lists, entries, sums or distances, near-region list, records, triangles.
// ads/pools.glsl says how pools are reached.
// The pool of lists has a word for each cell that has a list: the place where the list ends.
#ifndef BRICKS_ACCESSORS_GLSL
#define BRICKS_ACCESSORS_GLSL

#include "contract/bits.glsl"
#include "ads/constants.glsl"
#include "ads/views.glsl"
#include "bricks/header.glsl"
#include "ads/box_cells.glsl"
#include "bricks/slices.glsl"
#include "bricks/words.glsl"

POOL_WORDS(bricks, bricks, 1)
POOL_VECTORS(bricks, vectors, 1, uvec4, 16)
POOL_WORDS(bricks, lists, 2)
POOL_WORDS(bricks, entries, 3)
POOL_WORDS(bricks, sums, 4)
POOL_WORDS(bricks, near, 5)
POOL_WORDS(bricks, records, 6)
POOL_RECORDS(bricks, corners, 7, vec3)
#define BRICKS_POOL(s, pool) POOL_WORDS_OF(bricks, pool, BRICKS_HEADER(s))
#define BRICKS_VECTORS(s) POOL_VIEW_OF(bricks, vectors, BRICKS_HEADER(s).bricks_address)
#define BRICKS_CORNERS(s) POOL_VIEW_OF(bricks, corners, BRICKS_HEADER(s).triangles_address)

// Number of small triangles of a list; only if cells may be divided. A small triangle is no longer than a
// cell along any axis.
#define BRICKS_SMALL_COUNT(s, list) BRICKS_POOL(s, lists)[BRICKS_HEADER(s).cell_capacity + (list)]

// Distances of bricks. They take the place of the sums of scans.
#define BRICKS_DISTANCES(s) BRICKS_POOL(s, sums)

// Number of words of a record, and the bit beside the number of the brick that marks a small triangle.
#define BRICKS_RECORD_WORDS 4u
#define BRICKS_RECORD_SMALL 0x80000000u

// A triangle in a brick: those cells of the brick that the triangle reaches into, or some of them.
struct BricksRecord {
    uint primitive;       // number of the triangle in the bound geometry
    uint brick;           // number of the brick
    bool small;           // true if the triangle is no longer than a cell along any axis
    uvec2 cells;          // cells that it reaches into, as the bits of a mask
};

BricksSlices bricks_slices(BricksRef s) {
    return BricksSlices(int(BRICKS_HEADER(s).slices), BRICKS_HEADER(s).slice_first, BRICKS_HEADER(s).slice_shift);
}

// Returns how often the cells of a level are divided along each axis.
uvec3 bricks_divisions(BricksRef s, uint level) {
    return BRICKS_DEPTH == 0u ? uvec3(0u) : min(uvec3(level), BRICKS_HEADER(s).depths);
}

// Returns the layout of the cells of a level: those of the view, or smaller ones.
BoxCells bricks_axes(BricksRef s, uint level) {
    return BoxCells(BRICKS_HEADER(s).cells_lower, BRICKS_HEADER(s).cells_per_metre * vec3(uvec3(1u) << 2u * bricks_divisions(s, level)),
        BRICKS_HEADER(s).rounding);
}

// Returns the number of views: the faces of a cube, or one view along an axis.
uint bricks_view_count() {
    return BRICKS_VIEWS == BRICKS_VIEWS_AXES ? 1u : VIEW_FACES;
}

// Returns the number of columns, rows and slices of a view.
uvec3 bricks_cells(BricksRef s) {
    return uvec3(BRICKS_HEADER(s).columns, BRICKS_HEADER(s).rows, BRICKS_HEADER(s).slices);
}

uint bricks_total(BricksRef s) {
    return bricks_view_count() * bricks_count(bricks_cells(s));
}

// Returns the triangle of an entry of the lists. The entry must be within the pool.
uint bricks_entry(BricksRef s, uint entry) {
    return BRICKS_POOL(s, entries)[entry];
}

// Returns the triangle at a place of the near-region list.
uint bricks_near(BricksRef s, uint place) {
    return BRICKS_POOL(s, near)[place];
}

// Returns the number of cells that have a list within the pool.
uint bricks_listed_cells(BricksRef s) {
    return min(BRICKS_HEADER(s).cell_demand, BRICKS_HEADER(s).cell_capacity);
}

uint bricks_stored_records(BricksRef s) {
    return min(BRICKS_HEADER(s).record_demand, BRICKS_HEADER(s).record_capacity);
}

// Returns the number of bricks that are stored.
uint bricks_stored(BricksRef s) {
    return min(BRICKS_HEADER(s).brick_demand, BRICKS_HEADER(s).brick_capacity);
}

uvec2 bricks_mask(BricksRef s, uint brick) {
    return uvec2(BRICKS_POOL(s, bricks)[bricks_mask_at(brick, 0u)], BRICKS_POOL(s, bricks)[bricks_mask_at(brick, 1u)]);
}

// Returns the divided cells of a brick, as a mask.
uvec2 bricks_divided(BricksRef s, uint brick) {
    return BRICKS_DEPTH == 0u ? uvec2(0u)
        : uvec2(BRICKS_POOL(s, bricks)[bricks_divided_at(brick, 0u)], BRICKS_POOL(s, bricks)[bricks_divided_at(brick, 1u)]);
}

// The words of a brick that a ray reads.
struct BricksWords {
    uint word;            // word of the brick itself (bricks/words.glsl)
    uvec2 mask;           // cells that have a list
    uvec2 divided;        // cells that are divided; this and the rest only if cells may be divided
    uint child;           // number of the first of the bricks of these cells
    uint layer;           // for an empty brick: how far its layer of columns and slices is empty
};

// Reads all words of a brick at once; as whole vectors if cells may be divided.
BricksWords bricks_words(BricksRef s, uint brick) {
    if (BRICKS_DEPTH == 0u) {
        return BricksWords(BRICKS_POOL(s, bricks)[bricks_at(brick)], bricks_mask(s, brick), uvec2(0u), 0u, 0u);
    }
    uvec4 first = BRICKS_VECTORS(s)[2u * brick];
    uvec4 second = BRICKS_VECTORS(s)[2u * brick + 1u];
    return BricksWords(first.x, first.yz, uvec2(first.w, second.x), second.y, second.z);
}

// True if no cell of a brick of a view has a list or is divided.
bool bricks_has_nothing(BricksRef s, uint brick) {
    uvec2 cells = bricks_mask(s, brick) | bricks_divided(s, brick);
    return (cells.x | cells.y) == 0u;
}

// Returns the number of cells of a brick of a level along each axis: 4, or 1 along an axis that is not
// divided further at this level.
ivec3 bricks_side(BricksRef s, uint level) {
    return BRICKS_DEPTH == 0u ? ivec3(4) : mix(ivec3(1), ivec3(4), lessThanEqual(uvec3(level), BRICKS_HEADER(s).depths));
}

// Returns the position of a brick of a level, in bricks of that level.
uvec3 bricks_place_of(BricksRef s, uint brick, uint level) {
    if (level == 0u) {
        return bricks_place(brick, bricks_cells(s));
    }
    uint at = bricks_place_at(brick);
    uint columns = BRICKS_POOL(s, bricks)[at];
    return uvec3(columns & 0xFFFFu, columns >> 16, BRICKS_POOL(s, bricks)[at + 1u]);
}

// Sets bits of the mask of a brick.
void bricks_mark(BricksRef s, uint brick, uvec2 cells) {
    for (uint word = 0u; word < 2u; word++) {
        uint at = bricks_mask_at(brick, word);
        // The word is read first: most bits are set already, and reading costs less than an atomic.
        if ((BRICKS_POOL(s, bricks)[at] & cells[word]) != cells[word]) {
            atomicOr(BRICKS_POOL(s, bricks)[at], cells[word]);
        }
    }
}

// Stores a record of a level, and marks the cells in the mask of the brick. Beyond the capacity the record is
// only counted.
void bricks_store_record(BricksRef s, uint level, BricksRecord record) {
    uint place = atomicAdd(BRICKS_HEADER(s).record_demand, 1u);
    if (place < BRICKS_HEADER(s).record_capacity) {
        BRICKS_POOL(s, records)[BRICKS_RECORD_WORDS * place] = record.primitive;
        BRICKS_POOL(s, records)[BRICKS_RECORD_WORDS * place + 1u] = record.brick | (record.small ? BRICKS_RECORD_SMALL : 0u);
        BRICKS_POOL(s, records)[BRICKS_RECORD_WORDS * place + 2u] = record.cells.x;
        BRICKS_POOL(s, records)[BRICKS_RECORD_WORDS * place + 3u] = record.cells.y;
        bricks_mark(s, record.brick, record.cells);
        uint of_level = place - BRICKS_HEADER(s).record_first[level];
        if (of_level % BUILD_GROUP_SIZE == 0u) {
            atomicMax(BRICKS_HEADER(s).record_groups[3u * level], min(of_level / BUILD_GROUP_SIZE + 1u, BRICKS_GROUPS_MOST));
        }
    }
}

void bricks_set_cells(BricksRef s, uint place, uvec2 cells) {
    BRICKS_POOL(s, records)[BRICKS_RECORD_WORDS * place + 2u] = cells.x;
    BRICKS_POOL(s, records)[BRICKS_RECORD_WORDS * place + 3u] = cells.y;
}

BricksRecord bricks_record(BricksRef s, uint place) {
    uint brick = BRICKS_POOL(s, records)[BRICKS_RECORD_WORDS * place + 1u];
    return BricksRecord(BRICKS_POOL(s, records)[BRICKS_RECORD_WORDS * place], brick & ~BRICKS_RECORD_SMALL, (brick & BRICKS_RECORD_SMALL) != 0u,
        uvec2(BRICKS_POOL(s, records)[BRICKS_RECORD_WORDS * place + 2u], BRICKS_POOL(s, records)[BRICKS_RECORD_WORDS * place + 3u]));
}

#endif

// What: the contents of a cell of the bricks for a ray: the empty cells around it, or the list to test.
// Reads: bricks, lists, triangles, geometry. Writes: header.corrupted.
// Source: DIRT section 3.3, by cells of (column, row, slice) in bricks.
#ifndef BRICKS_CELL_GLSL
#define BRICKS_CELL_GLSL

#include "bricks/accessors.glsl"
#include "ads/evaluate.glsl"

// Values that are constant along a ray.
struct BrickTraversal {
    ivec3 cells;          // columns, rows and slices
    // The following is for the faces of a cube only.
    BrickSlices slices;
    float half_side;      // half the columns of a face
    float column;         // width of one in x/z
    float rounding;       // metres: bound of how far rounding moves the ray
    // Sizes of the lists.
    uint stored;          // entries
    uint listed;          // cells with a list
};

// Cells that a ray may cross in one step: all between first and last along each axis.
struct BrickBox {
    ivec3 first;
    ivec3 last;
    bool listed;          // one cell, which lists something
    uint list;
};

BrickBox brick_box(BrickRef s, BrickTraversal traversal, uint face, ivec3 cell, bvec3 up) {
    uint brick = brick_index(face, cell, uvec3(traversal.cells));
    uint word = BRICK_WORDS(s)[brick_at(brick)];
    BrickBox box = BrickBox(cell, cell, false, 0u);
    int inside = 0;
    int beyond = 0;
    if (BRICK_SKIP != 0u && brick_is_empty(word)) {
        inside = 3;
        beyond = 4 * brick_distance(word, brick_octant(up));
    } else {
        uint bits = BRICK_WORDS(s)[brick_mask_at(brick, brick_word(cell))];
        if (BRICK_SKIP != 0u && (bits & brick_octet(cell)) == 0u) {
            inside = 1;
        } else {
            uint bit = brick_bit(cell);
            box.listed = (bits >> bit & 1u) != 0u;
            if (box.listed) {
                box.list = word + uint(bitCount(bits & ((1u << bit) - 1u)))
                    + (brick_word(cell) != 0u ? uint(bitCount(BRICK_WORDS(s)[brick_mask_at(brick, 0u)])) : 0u);
            }
        }
    }
    box.first = max((cell & ~inside) - beyond, ivec3(0));
    box.last = min((cell | inside) + beyond, traversal.cells - 1);
    return box;
}

// Where the list of a cell begins and ends. One that leaves the pool is counted and is empty.
uvec2 brick_entries(BrickRef s, BrickTraversal traversal, uint list) {
    if (list < traversal.listed) {
        uvec2 entries = uvec2(list == 0u ? 0u : BRICK_LISTS(s)[list - 1u], BRICK_LISTS(s)[list]);
        if (entries.y <= traversal.stored) {
            return entries;
        }
    }
    atomicAdd(BRICK_HEADER(s).corrupted, 1u);
    return uvec2(0u);
}

// Tests a candidate with the corners kept here, or with those of the geometry. An invalid index is counted.
void brick_test(BrickRef s, uint primitive, Ray ray, inout TraceState state) {
    bool kept = BRICK_CORNERS_KEPT != 0u;
    if (primitive >= (kept ? BRICK_HEADER(s).triangle_capacity : geometry_triangle_count())) {
        atomicAdd(BRICK_HEADER(s).corrupted, 1u);
        return;
    }
    if (!kept) {
        test_anywhere(ray, primitive, state);
        return;
    }
    float infinity = uintBitsToFloat(0x7F800000u);
    state.tests++;
    test_corners(ray, primitive, BRICK_CORNERS(s)[3u * primitive], BRICK_CORNERS(s)[3u * primitive + 1u],
        BRICK_CORNERS(s)[3u * primitive + 2u], -infinity, infinity, state.best);
}

#endif

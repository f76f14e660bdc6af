// The contents of a cell of the bricks for a ray: the empty cells around it, or the list to test.
// Reads: bricks, lists, triangles, geometry. Writes: nothing.
// Source: DIRT section 3.3, by cells of (column, row, slice) in bricks.
#ifndef BRICKS_CELL_GLSL
#define BRICKS_CELL_GLSL

#include "bricks/accessors.glsl"
#include "ads/evaluate.glsl"

// Values that are constant along a ray.
struct BricksTraversal {
    ivec3 cells;          // columns, rows and slices, of the smallest cells
    ivec3 shift;          // log2 of the smallest cells along each side of a cell of a view
    float steepness;      // rows that the ray crosses for each column or slice, whichever are more
    // The following members are for the faces of a cube only.
    BricksSlices slices;
    float half_side;      // half the columns of a face
    float column;         // width of one in x/z
    float rounding;       // metres: bound of how far rounding moves the ray
    // Sizes of the pools.
    uint stored;          // entries
    uint listed;          // cells with a list
    uint bricks;
};

// Returns the number of empty bricks beyond an empty one: along all axes towards an octant, or farther along
// columns and slices alone if a ray crosses these in one step.
ivec3 bricks_empty_bricks(BricksWords words, uint octant, float steepness) {
    int cube = bricks_distance(words.word, octant);
    if (BRICKS_DEPTH != 0u) {
        int layer = bricks_layer_distance(words.layer, octant);
        if (layer > cube && min(1.0 / max(steepness, 1.0e-6), float(layer + 1)) * max(1.0, steepness) > float(cube + 1)) {
            return ivec3(layer, 0, layer);
        }
    }
    return ivec3(cube);
}

// Box of the smallest cells that a ray may cross in one step: all between first and last along each axis.
struct BricksBox {
    ivec3 first;
    ivec3 last;
    bool listed;          // one cell, which lists something
    uint list;
};

// Finds the box in a brick whose cells are 2^shift of the smallest along a side; it has one cell along an
// axis along which it would have less than 1. False if the cell is divided; `brick` is then the cell's brick.
bool bricks_box_in(BricksWords words, ivec3 shift, ivec3 cell, bvec3 up, inout uint brick, inout BricksBox box) {
    ivec3 size = max(shift, 0);
    ivec3 within = mix(ivec3(3), ivec3(0), lessThan(shift, ivec3(0)));
    ivec3 place = cell >> size;
    ivec3 at = place & within;
    uint word = bricks_word(at);
    uint bit = bricks_bit(at);
    if ((words.divided[word] >> bit & 1u) != 0u && any(greaterThan(shift, ivec3(0)))) {
        brick = words.child + bricks_rank(words.divided, word, bit);
        return false;
    }
    uvec2 all = words.mask | words.divided;
    ivec3 first = at;
    ivec3 last = at;
    bool listed = (words.mask[word] >> bit & 1u) != 0u;
    if (BRICKS_SKIP != 0u && !listed) {
        bricks_empty_cells(all, at, up, first, last);
    } else if (listed) {
        box.listed = true;
        box.list = words.word + bricks_rank(all, word, bit);
    }
    ivec3 corner = place - at;
    box.first = corner + (first & within) << size;
    box.last = (corner + (last & within) + 1 << size) - 1;
    return true;
}

// Finds the box crossed from a cell in one step. Bricks, lists and triangles with an invalid index are
// counted, here and below.
BricksBox bricks_box(BricksRef s, BricksTraversal traversal, uint face, ivec3 cell, bvec3 up, inout uint corrupted) {
    uvec3 of_view = uvec3(traversal.cells >> traversal.shift);
    uint brick = bricks_index(face, cell >> traversal.shift, of_view);
    BricksBox box = BricksBox(cell, cell, false, 0u);
    BricksWords words = bricks_words(s, brick);
    if (BRICKS_SKIP != 0u && bricks_is_empty(words.word)) {
        ivec3 inside = (ivec3(4) << traversal.shift) - 1;
        ivec3 beyond = bricks_empty_bricks(words, bricks_octant(up), traversal.steepness) * (inside + 1);
        box.first = max((cell & ~inside) - beyond, ivec3(0));
        box.last = min((cell | inside) + beyond, traversal.cells - 1);
        return box;
    }
    ivec3 shift = traversal.shift;
    for (uint level = 0u; level <= BRICKS_DEPTH; level++) {
        if (bricks_box_in(words, shift, cell, up, brick, box)) {
            break;
        }
        if (brick >= traversal.bricks) {
            corrupted += 1u;
            break;
        }
        words = bricks_words(s, brick);
        shift -= 2;
    }
    return box;
}

// Returns begin and end of the list of a cell. A list that leaves the pool is empty.
uvec2 bricks_entries(BricksRef s, BricksTraversal traversal, uint list, inout uint corrupted) {
    if (list < traversal.listed) {
        uvec2 entries = uvec2(list == 0u ? 0u : BRICKS_POOL(s, lists)[list - 1u], BRICKS_POOL(s, lists)[list]);
        if (entries.y <= traversal.stored) {
            return entries;
        }
    }
    corrupted += 1u;
    return uvec2(0u);
}

// Tests a candidate with its copied corners, or with those of the geometry.
void bricks_test(BricksRef s, uint primitive, Ray ray, inout TraceState state, inout uint corrupted) {
    bool kept = BRICKS_CORNERS_KEPT != 0u;
    if (primitive >= (kept ? BRICKS_HEADER(s).triangle_capacity : geometry_triangle_count())) {
        corrupted += 1u;
        return;
    }
    vec3 a;
    vec3 b;
    vec3 c;
    if (kept) {
        a = BRICKS_CORNERS(s)[3u * primitive];
        b = BRICKS_CORNERS(s)[3u * primitive + 1u];
        c = BRICKS_CORNERS(s)[3u * primitive + 2u];
    } else {
        geometry_vertices(primitive, a, b, c);
    }
    float infinity = uintBitsToFloat(0x7F800000u);
    state.tests++;
    test_corners(ray, primitive, a, b, c, -infinity, infinity, state.best);
}

#endif

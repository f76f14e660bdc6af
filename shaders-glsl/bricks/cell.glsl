// Finds what a ray meets in a cell of the bricks: a box of empty cells to cross in one step, or a list to
// test.
// Reads: bricks, lists, triangles, geometry. Writes: nothing.
// Source: DIRT section 3.3; here cells have a column, a row and a slice, and are grouped in bricks.
#ifndef BRICKS_CELL_GLSL
#define BRICKS_CELL_GLSL

#include "bricks/accessors.glsl"
#include "ads/evaluate.glsl"

// Values that do not change along a ray. The smallest cells are those of the most divided level.
struct BricksTraversal {
    ivec3 cells;          // columns, rows and slices of a view, counted in smallest cells
    ivec3 shift;          // log2 of the number of smallest cells in a cell of a view, along each axis
    // rows that the ray crosses per column or per slice, whichever of these it crosses more of
    float steepness;
    // The following members are for the faces of a cube only.
    BricksSlices slices;  // slices of a face
    float half_side;      // half the number of columns of a face
    float column;         // width of a column in x/z
    float rounding;       // bound of the shift of the ray by rounding, metres
    // These members are sizes of what the pools hold.
    uint stored;          // number of entries
    uint listed;          // number of cells with a list
    uint bricks;          // number of bricks
};

// Returns the number of empty bricks that a ray crosses beyond an empty one along each axis: equally many
// along all axes, or more along columns and slices and none along rows, if a ray with this steepness gets
// farther in that way.
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

// A box of smallest cells that a ray may cross in one step.
struct BricksBox {
    ivec3 first;          // first cell along each axis
    ivec3 last;           // last cell along each axis
    bool listed;          // true if the box is one cell that has a list
    uint list;            // number of the list
};

// Finds the box of cells around a cell within one brick. A cell of the brick has 2^shift smallest cells along
// each axis; a negative shift means that the brick was not divided along that axis, and has one cell. Returns
// false if the cell is divided; `brick` is then the number of the cell's own brick.
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

// Finds the box that a ray crosses from a cell in one step. Here and in the functions below, `corrupted`
// counts invalid indices of bricks, lists and triangles.
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

// Returns begin and end of the list of a cell. A list that leaves the pool is counted, and read as empty.
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

// Tests a triangle, with its copied corners or with those of the geometry.
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

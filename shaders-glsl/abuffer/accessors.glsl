// Declares the pools of an A-buffer, and reads and writes the bounds of its cells and the marks of triangles.
// Reads, writes: header, bounds, lists, nodes, data, near-region list, scratch, conservative lists. Stages
// that define STRUCTURE_READ_ONLY only read them.
// Functions that write bounds take a cell below abuffer_cell_count(s).
// Source: MMRT table 2, which lists what a cell and a node hold in each storage.
#ifndef ABUFFER_ACCESSORS_GLSL
#define ABUFFER_ACCESSORS_GLSL

#include "abuffer/views.glsl"
#include "ads/bucket.glsl"

POOL_WORDS(abuffer, bounds, 1)
POOL_WORDS(abuffer, lists, 2)
POOL_WORDS(abuffer, nodes, 3)
POOL_WORDS(abuffer, data, 4)
POOL_WORDS(abuffer, near, 5)
POOL_WORDS(abuffer, scratch, 6)
POOL_WORDS(abuffer, conservative, 7)
#define ABUFFER_POOL(s, pool) POOL_WORDS_OF(abuffer, pool, ABUFFER_HEADER(s))

// True if the storage divides a cell's depths into buckets with a list each. Cells then keep depth bounds.
const bool ABUFFER_BUCKETED = ABUFFER_STORAGE == ABUFFER_STORAGE_LLB || ABUFFER_STORAGE == ABUFFER_STORAGE_DLLB
    || ABUFFER_STORAGE == ABUFFER_STORAGE_PAGED;

// True if a cell has several lists. A cell that keeps its nearest fragments only has one list in every
// storage.
const bool ABUFFER_HAS_BUCKETS = ABUFFER_BUCKETED && ABUFFER_SINGLE_LAYER == 0u;

// True if each cell stores its ends: the smallest and the largest depth of its fragments.
const bool ABUFFER_HAS_ENDS = ABUFFER_BUCKETED || ABUFFER_STEP == ABUFFER_STEP_SKIPS || ABUFFER_SINGLE_LAYER != 0u;

// True if nodes lie in linked pages.
const bool ABUFFER_PAGED = ABUFFER_STORAGE == ABUFFER_STORAGE_PAGED;

// True if each node links to the nodes before and behind it.
const bool ABUFFER_DOUBLY = ABUFFER_STORAGE == ABUFFER_STORAGE_DLL || ABUFFER_STORAGE == ABUFFER_STORAGE_DLLB;

// True if the nodes of a list are contiguous and have no links.
const bool ABUFFER_CONTIGUOUS = ABUFFER_STORAGE == ABUFFER_STORAGE_SB;

// True if a list can also be read from its far end.
const bool ABUFFER_HAS_FAR_END = ABUFFER_DOUBLY || ABUFFER_CONTIGUOUS;

// True if each cell stores its extent: how far, in depth, its triangles reach from their fragments.
const bool ABUFFER_HAS_EXTENT = ABUFFER_TEST != ABUFFER_TEST_DEPTHS || ABUFFER_ACCEPT == ABUFFER_ACCEPT_SLOPE;

// Number of words of bounds per cell: the two ends, the extent, the scale of the buckets (if a cell has both
// buckets and an extent), and the head of the cell's conservative list. Each is stored only if it is used.
const uint ABUFFER_BOUNDS_STRIDE = (ABUFFER_HAS_ENDS ? 2u : 0u)
    + (ABUFFER_HAS_EXTENT ? (ABUFFER_HAS_BUCKETS ? 2u : 1u) : 0u) + (ABUFFER_HAS_CONSERVATIVE ? 1u : 0u);

// Word of the extent among the bounds of a cell. The scale is the next word.
const uint ABUFFER_EXTENT_WORD = ABUFFER_HAS_ENDS ? 2u : 0u;

// Number of words of a fragment's payload.
const uint ABUFFER_PAYLOAD_WORDS =
    ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_INDEX || ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_NORMAL ? 1u : 4u;

// Number of words of a fragment's payload together with the triangle that ABUFFER_IDS keeps for diagnostics.
const uint ABUFFER_DATA_STRIDE = ABUFFER_PAYLOAD_WORDS + ABUFFER_IDS;

// Word of a node's first link. Links follow the depth or, if the payload is inline, the payload.
const uint ABUFFER_LINK_WORD = ABUFFER_INLINE != 0u ? 1u + ABUFFER_DATA_STRIDE : 1u;

// Number of words of a node's links. Nodes in pages have no links. Contiguous nodes with inline payload have
// none either; with decoupled payload they have one word, which refers to their payload, because sorting
// moves the node but not the payload.
const uint ABUFFER_LINK_WORDS = ABUFFER_PAGED ? 0u
    : (ABUFFER_CONTIGUOUS ? (ABUFFER_INLINE != 0u ? 0u : 1u) : (ABUFFER_DOUBLY ? 2u : 1u));

// Number of words of a node: depth, inline payload, links.
const uint ABUFFER_NODE_STRIDE = ABUFFER_LINK_WORD + ABUFFER_LINK_WORDS;

// Number of nodes in a page, number of words before these nodes (the word that leads to the next page), and
// number of words of a whole page. Without pages, each node counts as a page of one node.
const uint ABUFFER_PAGE_SLOTS = ABUFFER_PAGED ? ABUFFER_PAGE : 1u;
const uint ABUFFER_PAGE_WORDS = ABUFFER_PAGED ? 1u : 0u;
const uint ABUFFER_PAGE_STRIDE = ABUFFER_PAGE_WORDS + ABUFFER_PAGE_SLOTS * ABUFFER_NODE_STRIDE;

// Finds the smallest depth of a cell's fragments. Returns false if the cell holds nothing.
bool abuffer_z_min(AbufferRef s, uint cell, out float z_min) {
    uint word = ABUFFER_POOL(s, bounds)[cell * ABUFFER_BOUNDS_STRIDE];
    z_min = uintBitsToFloat(~word);
    return word != 0u;
}

#ifndef STRUCTURE_READ_ONLY
// Widens the depth bounds of a cell. Word 0 holds the complement of the smallest depth's bits, so that a
// cleared cell is empty and atomicMax widens both ends: positive floats order like their bits.
void abuffer_widen_bounds(AbufferRef s, uint cell, float lower, float upper) {
    uint word = cell * ABUFFER_BOUNDS_STRIDE;
    atomicMax(ABUFFER_POOL(s, bounds)[word], ~floatBitsToUint(lower));
    atomicMax(ABUFFER_POOL(s, bounds)[word + 1u], floatBitsToUint(upper));
}

// Widens only the near end of a cell's bounds. Builds that keep the nearest fragments only find the near end
// before they store fragments; the far end is that of the fragments that are stored (abuffer_widen_far).
void abuffer_widen_near(AbufferRef s, uint cell, float z) {
    atomicMax(ABUFFER_POOL(s, bounds)[cell * ABUFFER_BOUNDS_STRIDE], ~floatBitsToUint(z));
}

void abuffer_widen_far(AbufferRef s, uint cell, float z) {
    atomicMax(ABUFFER_POOL(s, bounds)[cell * ABUFFER_BOUNDS_STRIDE + 1u], floatBitsToUint(z));
}

// Widens the extent of a cell, if cells store one.
void abuffer_widen_extent(AbufferRef s, uint cell, float extent) {
    if (ABUFFER_HAS_EXTENT) {
        uint word = cell * ABUFFER_BOUNDS_STRIDE + ABUFFER_EXTENT_WORD;
        atomicMax(ABUFFER_POOL(s, bounds)[word], floatBitsToUint(extent));
    }
}

// Stores the scale of a cell's buckets in the word behind the cell's extent.
void abuffer_store_scale(AbufferRef s, uint cell) {
    uint word = cell * ABUFFER_BOUNDS_STRIDE;
    uint z_max = ABUFFER_POOL(s, bounds)[word + 1u];
    float z_min = uintBitsToFloat(~ABUFFER_POOL(s, bounds)[word]);
    float scale = z_max == 0u ? 0.0 : bucket_scale(z_min, uintBitsToFloat(z_max), ABUFFER_BUCKETS);
    ABUFFER_POOL(s, bounds)[word + 3u] = floatBitsToUint(scale);
}
#endif

// Number of sets of marks, which have one bit per triangle. Set 0 marks the triangles that a cell keeps. With
// coverage edge-on there is a second set: set 0 then marks triangles that have a fragment, and decides the
// contents of conservative lists; set 1 marks the triangles in these lists.
uint abuffer_mark_sets() {
    return ABUFFER_COVERAGE == ABUFFER_COVERAGE_EDGE_ON ? 2u : 1u;
}

// Number of words of a set of marks. The sets lie behind the bounds of all cells.
uint abuffer_mark_words(AbufferRef s) {
    return (ABUFFER_HEADER(s).triangles + 31u) / 32u;
}

// Returns the word of the bounds pool that holds the first mark.
uint abuffer_marks(AbufferRef s) {
    return abuffer_cell_count(s) * ABUFFER_BOUNDS_STRIDE;
}

#ifndef STRUCTURE_READ_ONLY
// Marks in a set a triangle that a cell keeps. A triangle is marked for each such cell, so the bit is read
// before the atomic operation.
void abuffer_mark(AbufferRef s, uint primitive, uint set) {
    uint word = abuffer_marks(s) + set * abuffer_mark_words(s) + primitive / 32u;
    uint bit = 1u << (primitive % 32u);
    if (primitive < ABUFFER_HEADER(s).triangles && (ABUFFER_POOL(s, bounds)[word] & bit) == 0u) {
        atomicOr(ABUFFER_POOL(s, bounds)[word], bit);
    }
}
#endif

// True if a triangle has a fragment, by set 0 of the marks.
bool abuffer_is_marked(AbufferRef s, uint primitive) {
    uint word = abuffer_marks(s) + primitive / 32u;
    return primitive < ABUFFER_HEADER(s).triangles && (ABUFFER_POOL(s, bounds)[word] & 1u << (primitive % 32u)) != 0u;
}

// Returns the bounds of a cell. If cells do not store ends, the bounds contain all depths and are never
// empty: the lists then tell whether the cell holds anything.
AbufferBounds abuffer_bounds(AbufferRef s, uint cell) {
    AbufferBounds bounds = AbufferBounds(true, 0.0, 0.0, 0.0, 0.0);
    if (cell >= abuffer_cell_count(s)) {
        return bounds;
    }
    uint word = cell * ABUFFER_BOUNDS_STRIDE;
    if (ABUFFER_HAS_EXTENT) {
        bounds.extent = uintBitsToFloat(ABUFFER_POOL(s, bounds)[word + ABUFFER_EXTENT_WORD]);
    }
    if (!ABUFFER_HAS_ENDS) {
        bounds.empty = false;
        bounds.z_max = uintBitsToFloat(0x7F800000u);
        return bounds;
    }
    uint z_max = ABUFFER_POOL(s, bounds)[word + 1u];
    if (z_max == 0u) {
        return bounds;
    }
    bounds.empty = false;
    bounds.z_min = uintBitsToFloat(~ABUFFER_POOL(s, bounds)[word]);
    bounds.z_max = uintBitsToFloat(z_max);
    if (!ABUFFER_HAS_BUCKETS) {
        return bounds;
    }
    if (ABUFFER_HAS_EXTENT) {
        bounds.scale = uintBitsToFloat(ABUFFER_POOL(s, bounds)[word + 3u]);
    } else {
        bounds.scale = bucket_scale(bounds.z_min, bounds.z_max, ABUFFER_BUCKETS);
    }
    return bounds;
}

#endif

// The A-buffer's pools, reached as ads/pools.glsl says.
// Reads, writes: header, bounds, lists, nodes, data, near-region list, scratch, conservative lists; with STRUCTURE_READ_ONLY
// bounds are read only. Every access checks the capacity.
// Source: MMRT table 2: what a cell and a node hold under each storage.
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

// True if lists are divided by depth bucket, with depth bounds of each cell.
const bool ABUFFER_BUCKETED = ABUFFER_STORAGE == ABUFFER_STORAGE_LLB || ABUFFER_STORAGE == ABUFFER_STORAGE_DLLB
    || ABUFFER_STORAGE == ABUFFER_STORAGE_PAGED;

// True if a cell has several lists; if only the nearest fragments are kept it has one, whatever the storage.
const bool ABUFFER_HAS_BUCKETS = ABUFFER_BUCKETED && ABUFFER_SINGLE_LAYER == 0u;

// True if cells know the smallest and largest depth of their fragments.
const bool ABUFFER_HAS_ENDS = ABUFFER_BUCKETED || ABUFFER_STEP == ABUFFER_STEP_SKIPS || ABUFFER_SINGLE_LAYER != 0u;

// True if nodes lie in pages that are linked.
const bool ABUFFER_PAGED = ABUFFER_STORAGE == ABUFFER_STORAGE_PAGED;

// True if nodes link both ways.
const bool ABUFFER_DOUBLY = ABUFFER_STORAGE == ABUFFER_STORAGE_DLL || ABUFFER_STORAGE == ABUFFER_STORAGE_DLLB;

// True if the nodes of a list are contiguous, without links.
const bool ABUFFER_CONTIGUOUS = ABUFFER_STORAGE == ABUFFER_STORAGE_SB;

// True if lists can be read from their far end.
const bool ABUFFER_HAS_FAR_END = ABUFFER_DOUBLY || ABUFFER_CONTIGUOUS;

// True if cells store the reach of triangles in depth from their fragments.
const bool ABUFFER_HAS_EXTENT = ABUFFER_TEST != ABUFFER_TEST_DEPTHS || ABUFFER_ACCEPT == ABUFFER_ACCEPT_SLOPE;

// Number of words of bounds per cell: ends, the extent, the scale if there are buckets as well as an extent,
// and the head of the cell's conservative list.
const uint ABUFFER_BOUNDS_STRIDE = (ABUFFER_HAS_ENDS ? 2u : 0u)
    + (ABUFFER_HAS_EXTENT ? (ABUFFER_HAS_BUCKETS ? 2u : 1u) : 0u) + (ABUFFER_HAS_CONSERVATIVE ? 1u : 0u);

// Word of the extent among a cell's bounds; the scale is the next word.
const uint ABUFFER_EXTENT_WORD = ABUFFER_HAS_ENDS ? 2u : 0u;

// Number of words of a fragment's payload.
const uint ABUFFER_PAYLOAD_WORDS =
    ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_INDEX || ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_NORMAL ? 1u : 4u;

// Number of words of a fragment's payload and of the triangle that is kept for diagnostics.
const uint ABUFFER_DATA_STRIDE = ABUFFER_PAYLOAD_WORDS + ABUFFER_IDS;

// Word of a node's first link: after the depth, and after the payload if that is inline.
const uint ABUFFER_LINK_WORD = ABUFFER_INLINE != 0u ? 1u + ABUFFER_DATA_STRIDE : 1u;

// Number of words of a node's links. Nodes in pages and contiguous ones have none; decoupled contiguous nodes
// refer to their payload instead, because sorting moves them.
const uint ABUFFER_LINK_WORDS = ABUFFER_PAGED ? 0u
    : (ABUFFER_CONTIGUOUS ? (ABUFFER_INLINE != 0u ? 0u : 1u) : (ABUFFER_DOUBLY ? 2u : 1u));

// Number of words of a node: depth, inline payload, links.
const uint ABUFFER_NODE_STRIDE = ABUFFER_LINK_WORD + ABUFFER_LINK_WORDS;

// Pages: nodes of a page, the word before them that leads to the next page, and words of a whole page;
// without pages each node counts as one.
const uint ABUFFER_PAGE_SLOTS = ABUFFER_PAGED ? ABUFFER_PAGE : 1u;
const uint ABUFFER_PAGE_WORDS = ABUFFER_PAGED ? 1u : 0u;
const uint ABUFFER_PAGE_STRIDE = ABUFFER_PAGE_WORDS + ABUFFER_PAGE_SLOTS * ABUFFER_NODE_STRIDE;

// Finds the smallest depth of a cell; false if the cell holds nothing.
bool abuffer_z_min(AbufferRef s, uint cell, out float z_min) {
    uint word = ABUFFER_POOL(s, bounds)[cell * ABUFFER_BOUNDS_STRIDE];
    z_min = uintBitsToFloat(~word);
    return word != 0u;
}

#ifndef STRUCTURE_READ_ONLY
// Widens the depths of a cell. Word 0 holds the complement of the smallest depth's bits, so that a cleared
// cell is empty and both ends are maxima; positive floats order like their bits.
void abuffer_widen_bounds(AbufferRef s, uint cell, float lower, float upper) {
    uint word = cell * ABUFFER_BOUNDS_STRIDE;
    atomicMax(ABUFFER_POOL(s, bounds)[word], ~floatBitsToUint(lower));
    atomicMax(ABUFFER_POOL(s, bounds)[word + 1u], floatBitsToUint(upper));
}

// Widens one end only, if only the nearest fragments are kept: the near end is known before they are stored,
// the far end is that of the stored fragments.
void abuffer_widen_near(AbufferRef s, uint cell, float z) {
    atomicMax(ABUFFER_POOL(s, bounds)[cell * ABUFFER_BOUNDS_STRIDE], ~floatBitsToUint(z));
}

void abuffer_widen_far(AbufferRef s, uint cell, float z) {
    atomicMax(ABUFFER_POOL(s, bounds)[cell * ABUFFER_BOUNDS_STRIDE + 1u], floatBitsToUint(z));
}

// Widens the extent of a cell, if it has one.
void abuffer_widen_extent(AbufferRef s, uint cell, float extent) {
    if (ABUFFER_HAS_EXTENT) {
        uint word = cell * ABUFFER_BOUNDS_STRIDE + ABUFFER_EXTENT_WORD;
        atomicMax(ABUFFER_POOL(s, bounds)[word], floatBitsToUint(extent));
    }
}

// Stores the scale of a cell's buckets next to its bounds.
void abuffer_store_scale(AbufferRef s, uint cell) {
    uint word = cell * ABUFFER_BOUNDS_STRIDE;
    uint z_max = ABUFFER_POOL(s, bounds)[word + 1u];
    float z_min = uintBitsToFloat(~ABUFFER_POOL(s, bounds)[word]);
    float scale = z_max == 0u ? 0.0 : bucket_scale(z_min, uintBitsToFloat(z_max), ABUFFER_BUCKETS);
    ABUFFER_POOL(s, bounds)[word + 3u] = floatBitsToUint(scale);
}
#endif

// Number of sets of marks of triangles: one set of the triangles that cells keep; with coverage edge-on, where marks
// decide the contents of conservative lists, two: of triangles that have a fragment, and of those in such lists.
uint abuffer_mark_sets() {
    return ABUFFER_COVERAGE == ABUFFER_COVERAGE_EDGE_ON ? 2u : 1u;
}

// Number of words of a set of marks, a bit each, behind the bounds of all cells.
uint abuffer_mark_words(AbufferRef s) {
    return (ABUFFER_HEADER(s).triangles + 31u) / 32u;
}

// Returns the word that holds the first mark.
uint abuffer_marks(AbufferRef s) {
    return abuffer_cell_count(s) * ABUFFER_BOUNDS_STRIDE;
}

#ifndef STRUCTURE_READ_ONLY
// Marks in a set a triangle that a cell keeps.
void abuffer_mark(AbufferRef s, uint primitive, uint set) {
    uint word = abuffer_marks(s) + set * abuffer_mark_words(s) + primitive / 32u;
    uint bit = 1u << (primitive % 32u);
    if (primitive < ABUFFER_HEADER(s).triangles && (ABUFFER_POOL(s, bounds)[word] & bit) == 0u) {
        atomicOr(ABUFFER_POOL(s, bounds)[word], bit);
    }
}
#endif

// True if a triangle has a fragment.
bool abuffer_is_marked(AbufferRef s, uint primitive) {
    uint word = abuffer_marks(s) + primitive / 32u;
    return primitive < ABUFFER_HEADER(s).triangles && (ABUFFER_POOL(s, bounds)[word] & 1u << (primitive % 32u)) != 0u;
}

// Returns the bounds of a cell. Without ends they hold everything, and lists tell whether there is anything.
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

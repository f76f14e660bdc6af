// Declares the pools of voxels with axis A-buffers, and reads and writes voxels and fragments.
// Reads, writes: header, voxels, normals, lists, fragments, scratch, nodes, octants. Stages that define
// STRUCTURE_READ_ONLY only read them.
// Each cell of a view has a list, with one word in the pool of lists (voxel/lists.glsl). If voxels are the
// leaves there are no lists, and these words hold the triangles of voxels.
// A place is the number of a fragment; with pages, the number of a slot.
#ifndef VOXEL_ACCESSORS_GLSL
#define VOXEL_ACCESSORS_GLSL

#include "voxel/header.glsl"
#include "ads/axis_views.glsl"
#include "ads/constants.glsl"

POOL_WORDS(voxel, voxels, 1)
POOL_WORDS(voxel, normals, 2)
POOL_WORDS(voxel, lists, 3)
POOL_WORDS(voxel, fragments, 4)
POOL_WORDS(voxel, scratch, 5)
POOL_WORDS(voxel, nodes, 6)
POOL_WORDS(voxel, octants, 7)
#define VOXEL_POOL(s, pool) POOL_WORDS_OF(voxel, pool, VOXEL_HEADER(s))

// Returns the view along an axis, with the cells in which fragments are kept.
AxisView voxel_view(VoxelRef s, uint axis) {
    return AxisView(VOXEL_HEADER(s).lower, VOXEL_HEADER(s).cell, VOXEL_HEADER(s).resolution, axis);
}

// Returns the view along an axis, with one cell per column of voxels.
AxisView voxel_column_view(VoxelRef s, uint axis) {
    return AxisView(VOXEL_HEADER(s).lower, VOXEL_HEADER(s).voxel, VOXEL_HEADER(s).grid, axis);
}

uint voxel_count(VoxelRef s) {
    uint grid = VOXEL_HEADER(s).grid;
    return grid * grid * grid;
}

// Returns the running index of a voxel, or 2^32 - 1 if the voxel is outside the grid.
uint voxel_index(VoxelRef s, ivec3 voxel) {
    uint grid = VOXEL_HEADER(s).grid;
    uvec3 v = uvec3(voxel);
    return any(greaterThanEqual(v, uvec3(grid))) ? 0xFFFFFFFFu : (v.z * grid + v.y) * grid + v.x;
}

// Sets bits of a voxel. An index outside the grid is ignored.
void voxel_mark(VoxelRef s, uint index, uint bits) {
    if (index < voxel_count(s)) {
        uint shift = VOXEL_BITS * (index % 8u);
        // Many fragments mark the same voxel, so most calls find the bits set.
        if ((VOXEL_POOL(s, voxels)[index / 8u] >> shift & bits) != bits) {
            atomicOr(VOXEL_POOL(s, voxels)[index / 8u], bits << shift);
        }
    }
}

// Returns the bits of a voxel: one for each axis along which it is searched, and VOXEL_OCCUPIED. They are 0
// outside the grid.
uint voxel_bits(VoxelRef s, uint index) {
    return index < voxel_count(s) ? VOXEL_POOL(s, voxels)[index / 8u] >> (VOXEL_BITS * (index % 8u)) & 15u : 0u;
}

// Makes a triangle represent a voxel if its id is the lowest so far. Words begin as zeros and hold
// complements, so that the largest word is that of the lowest id.
void voxel_hold_triangle(VoxelRef s, uint index, uint primitive) {
    if (index < voxel_count(s) && VOXEL_POOL(s, lists)[index] < ~primitive) {
        atomicMax(VOXEL_POOL(s, lists)[index], ~primitive);
    }
}

// Returns the triangle that represents an occupied voxel.
uint voxel_triangle(VoxelRef s, uint index) {
    return ~VOXEL_POOL(s, lists)[index];
}

// Returns the size of the elements that rays hit (cells or voxels), metres. Points of an element are at most
// that far from the surface.
float voxel_leaf_size(VoxelRef s) {
    return VOXEL_LEAVES == VOXEL_LEAVES_VOXELS ? VOXEL_HEADER(s).voxel : VOXEL_HEADER(s).cell;
}

// True if the view along an axis keeps the fragments that lie in a voxel.
bool voxel_keeps(VoxelRef s, uint index, uint axis) {
    return VOXEL_AXES != VOXEL_AXES_VOXEL || (voxel_bits(s, index) >> axis & 1u) != 0u;
}

// Adds a triangle's unit normal to the sum of normals of a voxel. Components are added as whole numbers, so
// that the order of additions does not matter.
void voxel_add_normal(VoxelRef s, uint index, vec3 normal) {
    if (index < voxel_count(s)) {
        ivec3 steps = ivec3(round(normal * VOXEL_NORMAL_STEPS));
        for (uint k = 0u; k < 3u; k++) {
            if (steps[k] != 0) {
                atomicAdd(VOXEL_POOL(s, normals)[3u * index + k], uint(steps[k]));
            }
        }
    }
}

// Returns the axis to which a voxel's averaged normal is closest. Ties go to the lowest axis.
uint voxel_normal_axis(VoxelRef s, uint index) {
    uvec3 size;
    for (uint k = 0u; k < 3u; k++) {
        size[k] = uint(abs(int(VOXEL_POOL(s, normals)[3u * index + k])));
    }
    return size.x >= size.y && size.x >= size.z ? 0u : (size.y >= size.z ? 1u : 2u);
}

uint voxel_list_count(VoxelRef s) {
    uint resolution = VOXEL_HEADER(s).resolution;
    return AXIS_VIEWS * resolution * resolution;
}

// True if the fragments of a list are contiguous and have no links.
bool voxel_contiguous() {
    return VOXEL_STORAGE == VOXEL_STORAGE_CONTIGUOUS;
}

// Returns the number of words at the front of the scratch pool that hold the sums of the scan.
uint voxel_scan_words(VoxelRef s) {
    return voxel_contiguous() ? (voxel_list_count(s) + SCAN_BLOCK - 1u) / SCAN_BLOCK : 0u;
}

// True if fragments lie in linked pages.
bool voxel_paged() {
    return VOXEL_STORAGE == VOXEL_STORAGE_PAGED;
}

// Returns the number of places that the build has filled; with pages, the number of slots of all pages that
// it began.
uint voxel_stored(VoxelRef s) {
    return min(VOXEL_HEADER(s).capacity, VOXEL_HEADER(s).demand) * (voxel_paged() ? VOXEL_PAGE : 1u);
}

// Returns the number of words of a fragment: its depth, a word of payload, with attributes also colour and
// normal, and with VOXEL_IDS the triangle that is kept for diagnostics.
uint voxel_stride() {
    return (VOXEL_PAYLOAD == VOXEL_PAYLOAD_INDEX ? 2u : 4u) + VOXEL_IDS;
}

// Returns the number of words of a page: the word that leads to the next page, and the fragments.
uint voxel_page_stride() {
    return 1u + VOXEL_PAGE * voxel_stride();
}

// Returns the first word of a fragment. A linked fragment has its link behind its other words.
uint voxel_first_word(uint place) {
    if (voxel_paged()) {
        return place / VOXEL_PAGE * voxel_page_stride() + 1u + place % VOXEL_PAGE * voxel_stride();
    }
    return place * (voxel_contiguous() ? voxel_stride() : voxel_stride() + 1u);
}

uint voxel_word(VoxelRef s, uint place, uint word) {
    return VOXEL_POOL(s, fragments)[voxel_first_word(place) + word];
}

void voxel_set_word(VoxelRef s, uint place, uint word, uint value) {
    VOXEL_POOL(s, fragments)[voxel_first_word(place) + word] = value;
}

// Returns the depth of a fragment at the centre of its cell, metres from the lower side of the cube.
float voxel_z(VoxelRef s, uint place) {
    return uintBitsToFloat(voxel_word(s, place, 0u));
}

// Returns the triangle of a fragment; PRIMITIVE_UNKNOWN if the fragment stores a material in its place.
uint voxel_primitive(VoxelRef s, uint place) {
    return VOXEL_PAYLOAD == VOXEL_PAYLOAD_MATERIAL ? PRIMITIVE_UNKNOWN : voxel_word(s, place, 1u);
}

// True if the left one of two fragments of equal depth comes first: by its triangle, or by its payload where
// fragments have no triangle.
bool voxel_comes_first(VoxelRef s, uint left, uint right) {
    uvec2 first = uvec2(voxel_word(s, left, 1u), voxel_word(s, right, 1u));
    if (VOXEL_PAYLOAD != VOXEL_PAYLOAD_MATERIAL || first.x != first.y) {
        return first.x < first.y;
    }
    uvec2 second = uvec2(voxel_word(s, left, 2u), voxel_word(s, right, 2u));
    return second.x < second.y || (second.x == second.y && voxel_word(s, left, 3u) < voxel_word(s, right, 3u));
}

// Exchanges a word of two fragments.
void voxel_swap_word(VoxelRef s, uint left, uint right, uint word) {
    uint of_left = voxel_word(s, left, word);
    voxel_set_word(s, left, word, voxel_word(s, right, word));
    voxel_set_word(s, right, word, of_left);
}

// Exchanges two fragments. There is no loop over their words, since a sort has no iterations to spare.
void voxel_swap(VoxelRef s, uint left, uint right) {
    voxel_swap_word(s, left, right, 0u);
    voxel_swap_word(s, left, right, 1u);
    if (VOXEL_PAYLOAD != VOXEL_PAYLOAD_INDEX) {
        voxel_swap_word(s, left, right, 2u);
        voxel_swap_word(s, left, right, 3u);
    }
    if (VOXEL_IDS != 0u) {
        voxel_swap_word(s, left, right, 4u);
    }
}

#endif

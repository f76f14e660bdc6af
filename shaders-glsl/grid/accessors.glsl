// What: the pools of a grid, and the only place that knows how they are reached: through the descriptors of
// STRUCTURE_SET, or (ADDRESSING_ADDRESS) through the device addresses of the header.
// Reads, writes: header, lists, entries, scratch. Lists hold a word per cell: the length of its list, then where it
// begins, and once all entries are stored where it ends. Scratch holds the sums of the scan, and behind these the
// large-triangle queue.
#ifndef GRID_ACCESSORS_GLSL
#define GRID_ACCESSORS_GLSL

#include "ads/box_cells.glsl"
#include "ads/constants.glsl"
#include "grid/header.glsl"

#ifdef ADDRESSING_ADDRESS
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer GridWordAddress { uint words[]; };
#define GRID_LISTS(s) GridWordAddress(GRID_HEADER(s).lists_address).words
#define GRID_ENTRIES(s) GridWordAddress(GRID_HEADER(s).entries_address).words
#define GRID_SCRATCH(s) GridWordAddress(GRID_HEADER(s).scratch_address).words
#else
layout(set = STRUCTURE_SET, binding = 1, scalar) buffer GridListsBuffer { uint grid_list_words[]; };
layout(set = STRUCTURE_SET, binding = 2, scalar) buffer GridEntriesBuffer { uint grid_entry_words[]; };
layout(set = STRUCTURE_SET, binding = 3, scalar) buffer GridScratchBuffer { uint grid_scratch_words[]; };
#define GRID_LISTS(s) grid_list_words
#define GRID_ENTRIES(s) grid_entry_words
#define GRID_SCRATCH(s) grid_scratch_words
#endif

uvec3 grid_cells(GridRef s) {
    return uvec3(GRID_HEADER(s).cells[0], GRID_HEADER(s).cells[1], GRID_HEADER(s).cells[2]);
}

uint grid_cell_count(GridRef s) {
    return GRID_HEADER(s).cells[0] * GRID_HEADER(s).cells[1] * GRID_HEADER(s).cells[2];
}

// Index of the list of a cell; lists of a column are contiguous.
uint grid_list(ivec3 cell, uvec3 cells) {
    return (uint(cell.y) * cells.x + uint(cell.x)) * cells.z + uint(cell.z);
}

BoxCells grid_box_cells(GridRef s) {
    return BoxCells(GRID_HEADER(s).cells_lower, GRID_HEADER(s).cells_per_metre, GRID_HEADER(s).rounding);
}

// Entries that are stored.
uint grid_stored(GridRef s) {
    return min(GRID_HEADER(s).demand, GRID_HEADER(s).capacity);
}

// Words of scratch before the large-triangle queue.
uint grid_scan_words(GridRef s) {
    return (grid_cell_count(s) + SCAN_BLOCK - 1u) / SCAN_BLOCK;
}

#endif

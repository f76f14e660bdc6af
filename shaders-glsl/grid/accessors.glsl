// Access to the pools of a grid.
// Reads, writes: header, lists, entries, scratch. ads/pools.glsl says how pools are reached.
// The pool of lists has one word per cell. It holds the length of the cell's list, then the place of its
// begin, and once all entries are stored the place of its end. The pool of scratch holds the sums of the
// scan, and behind them the large-triangle queue.
#ifndef GRID_ACCESSORS_GLSL
#define GRID_ACCESSORS_GLSL

#include "ads/box_cells.glsl"
#include "ads/constants.glsl"
#include "grid/header.glsl"

POOL_WORDS(grid, lists, 1)
POOL_WORDS(grid, entries, 2)
POOL_WORDS(grid, scratch, 3)
#define GRID_POOL(s, pool) POOL_WORDS_OF(grid, pool, GRID_HEADER(s))

uvec3 grid_cells(GridRef s) {
    return uvec3(GRID_HEADER(s).cells[0], GRID_HEADER(s).cells[1], GRID_HEADER(s).cells[2]);
}

uint grid_cell_count(GridRef s) {
    return GRID_HEADER(s).cells[0] * GRID_HEADER(s).cells[1] * GRID_HEADER(s).cells[2];
}

// Returns the index of the list of a cell. Lists of the cells of a column are consecutive.
uint grid_list(ivec3 cell, uvec3 cells) {
    return (uint(cell.y) * cells.x + uint(cell.x)) * cells.z + uint(cell.z);
}

BoxCells grid_box_cells(GridRef s) {
    return BoxCells(GRID_HEADER(s).cells_lower, GRID_HEADER(s).cells_per_metre, GRID_HEADER(s).rounding);
}

// Returns the number of entries that are stored.
uint grid_stored(GridRef s) {
    return min(GRID_HEADER(s).demand, GRID_HEADER(s).capacity);
}

// Returns the number of words of scratch that lie before the large-triangle queue.
uint grid_scan_words(GridRef s) {
    return (grid_cell_count(s) + SCAN_BLOCK - 1u) / SCAN_BLOCK;
}

#endif

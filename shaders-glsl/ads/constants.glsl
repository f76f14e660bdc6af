// Numbers that the shared build passes and their recording in Rust share. Only `#define NAME number` may stand here.
#ifndef ADS_CONSTANTS_GLSL
#define ADS_CONSTANTS_GLSL

// Views onto which one draw of all triangles goes at most: the faces of a cube.
#define GEOMETRY_DRAW_VIEWS 6u

// Numbers that one workgroup of a scan adds up, and its threads.
#define SCAN_BLOCK 1024u
#define SCAN_THREADS 256u

// Longest list that is sorted in one dispatch: a heap of so many takes 27,000 steps at most.
#define SHORT_LIST_LIMIT 2048u

// Dispatches that sort longer lists, and the steps of a list in each: drivers may end all loops of an invocation after
// 65,535 iterations.
#define LONG_LIST_ROUNDS 16u
#define LONG_LIST_STEPS 60000u

// Longest list that those dispatches sort: a heap of so many takes 875,000 steps at most. Longer ones stay unordered
// and are counted.
#define LONG_LIST_LIMIT 50000u

// Longest list of nodes that is sorted in one dispatch, and steps that suffice for it, which is merged ten times.
#define NODE_SORT_LIMIT 1024u
#define NODE_SORT_STEPS 24000u

// Linked lists that one thread sorts, within the same steps; most have a node or none. 32 at most.
#define NODE_SORT_LISTS 16u

// Longest list of nodes that the dispatches for longer ones sort: it is counted and merged once within LONG_LIST_STEPS,
// and 15 times in all. Longer ones stay unordered and are counted.
#define NODE_SORT_LONG_LIMIT 19000u

// What stands for the progress of a list that is sorted.
#define LONG_LIST_DONE 0xFFFFFFFFu

// Longest list that is searched for a fragment that stands for a triangle beside the cell's centre; in cells
// with more, every such triangle is kept.
#define FRINGE_LIMIT 4096u

// A fragment stands for a triangle beside the centre if its plane passes the triangle's nearest point this close,
// in widths of a cell or, where that is smaller, of the triangle.
#define FRINGE_DEPTH 0.25

// Rays whose origin is farther from the centre of the views than this many times the geometry are tested against every
// triangle where no hit may be lost: their rounding exceeds what the cells near the centre can bear.
#define ORIGIN_LIMIT 4.0

// Bound of how far rounding moves a triangle against the ray that is marched, over the distance of the
// geometry: 24 units of rounding for each of the five distances between origin and hit.
#define TRIANGLE_ROUNDING 7.2e-6

// Half side of the near box over cells a side times the distance of the geometry where no hit may be lost:
// there a cell is as wide as the guard of the march, 16 units of rounding for each of nine distances.
#define NEAR_BOX 4.8e-6

// Cells list what lies within the rounding of the test in two coordinates (240 units) and that of the march (96), over
// the distance of the geometry.
#define CELL_ROUNDING 2.0e-5

// Pages that the word of a list can name beside how many of their slots are used.
#define PAGE_LIMIT 0x0FFFFFFEu

// Most cells of a view that one invocation of a binning builder looks at; triangles with more in it get workgroups.
#define BIN_CELLS 64
// Threads of those, and how often the loops of one turn at most.
#define BIN_GROUP_SIZE 64u
#define BIN_TURNS 30000
// Workgroups a row of their dispatch.
#define BIN_PAIR_ROW 32768u

// Threads in a workgroup of the pass that builds a pyramid.
#define PYRAMID_THREADS 64u

#endif

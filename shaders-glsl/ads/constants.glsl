// Numbers that the shared build passes and their recording in Rust share. Only `#define NAME number` may stand here.
#ifndef ADS_CONSTANTS_GLSL
#define ADS_CONSTANTS_GLSL

// Maximum number of views onto which one draw of all triangles goes: the faces of a cube.
#define GEOMETRY_DRAW_VIEWS 6u

// Number of stamps of a geometry whose triangles the device counts: each change of their number takes another
// one, in turns.
#define GEOMETRY_COUNT_STAMPS 1024u
// Bit of a stamp, among the bits of STATUS_FLAGS, that is set from the count of other triangles until their
// indices are gathered: meanwhile no status belongs to a build of these triangles.
#define GEOMETRY_NOT_GATHERED 1u

// Bytes in the buffer of a geometry's header: of the header, of each run of a part behind it, and of the map
// of a part that is built in a space of its own, which is at a multiple of these bytes.
#define GEOMETRY_HEADER_BYTES 112u
#define GEOMETRY_RUN_BYTES 8u
#define GEOMETRY_RIGID_BYTES 72u

// Role of a structure in a trace: all triangles; the part that is traced first; or a following part, which
// goes on from the hits of the parts before in the queue.
#define PART_WHOLE 0u
#define PART_FIRST 1u
#define PART_NEXT 2u
// Summand of the role, where surfaces are found, for each part that was traced after it.
#define PART_AFTER 4u

// Rule for fragments as close to an end of the ray as those of the surface there: they are counted, or not.
#define ENDS_TOUCHING 0u
#define ENDS_CLEAR 1u

// Numbers that one workgroup of a scan adds up, its threads, and the numbers that make a row.
#define SCAN_BLOCK 1024u
#define SCAN_THREADS 256u
#define SCAN_ROW 16u

// Threads in a workgroup of the passes of a structure's own build.
#define BUILD_GROUP_SIZE 64u

// Threads in a workgroup of the passes that sort lists.
#define SORT_GROUP_SIZE 64u

// Longest list that is sorted in one dispatch: a heap of that many takes at most 27,000 steps.
#define SHORT_LIST_LIMIT 2048u

// Dispatches that sort longer lists, and the steps of a list in each: drivers may end all loops of an
// invocation after 65,535 iterations.
#define LONG_LIST_ROUNDS 16u
#define LONG_LIST_STEPS 60000u

// Longest list that these dispatches sort: a heap of this size takes at most 875,000 steps. Longer lists stay
// unordered and are counted.
#define LONG_LIST_LIMIT 50000u

// Longest list of nodes that is sorted in one dispatch, by ten merges, and the number of steps that is enough
// for it.
#define NODE_SORT_LIMIT 1024u
#define NODE_SORT_STEPS 24000u

// Maximum number of linked lists that one thread sorts, within the same number of steps; few lists have more than one
// node. At most 32.
#define NODE_SORT_LISTS 16u

// Longest list of nodes that the dispatches for longer ones sort: it is counted and merged once within
// LONG_LIST_STEPS, and 15 times in all. Longer lists stay unordered and are counted.
#define NODE_SORT_LONG_LIMIT 19000u

// Progress of a list that is sorted completely.
#define LONG_LIST_DONE 0xFFFFFFFFu

// Longest list that is searched for a fragment that can represent a triangle which misses the cell's centre.
// In cells with longer lists every such triangle goes into the conservative list.
#define CONSERVATIVE_LIMIT 4096u

// A fragment represents a triangle that misses the centre if the distance of its plane from the triangle's nearest
// point is at most this, in widths of the cell or, where that is smaller, of the triangle.
#define CONSERVATIVE_DEPTH 0.25

// Distance of a ray's origin from the centre of the views, in multiples of the geometry's, beyond which the
// ray is tested against every triangle if no hit may be lost: its rounding exceeds the margins of the cells
// near the centre.
#define ORIGIN_LIMIT 4.0

// Bound of the shift by rounding of a triangle against the ray that is marched, over the distance of the
// geometry: 24 units of rounding for each of the five distances between origin and hit.
#define TRIANGLE_ROUNDING 7.2e-6

// Half side of the near region, divided by the number of cells along a side and by the distance of the geometry, where
// no hit may be lost. At that distance a cell is as wide as the rounding guard of the march, 16 units of rounding for
// each of nine distances.
#define NEAR_REGION 4.8e-6

// Margin within which cells list triangles, over the distance of the geometry: the rounding of the test in
// two coordinates (240 units) and that of the march (96).
#define CELL_ROUNDING 2.0e-5

// Distance of an eye, in multiples of the geometry's, below which header passes (ads/placement.glsl) need no
// wider margins, and views need not come nearer to the eye: a little less than ORIGIN_LIMIT.
#define PLACEMENT_EYE_LIMIT 3.5
// Share of the bounds, on each side, that separates a centre from the sides: about a quarter, and not a
// fraction at which a scene is likely to have a wall.
#define PLACEMENT_MARGIN 0.2718
// Share of the bounds, from their lower corner, at which a centre lies that does not follow the eye: about
// the middle, and not a fraction at which a scene is likely to have a wall.
#define PLACEMENT_MIDDLE 0.4718
// Ratio of the shortest to the longest side below which bounds have no inside: a centre among their triangles
// would see them all edge-on and across many tiles.
#define PLACEMENT_FLATTEST 0.25
// Largest margin of cells along axes for a distant eye, as a share of a cell.
#define PLACEMENT_WIDEST_MARGIN 0.125
// Number of margins by which cells along axes reach below the bounds, and above them.
#define PLACEMENT_BELOW 6.0
#define PLACEMENT_ABOVE 10.0
// Ratio of the side of a cube to the longest side of the geometry in it.
#define PLACEMENT_WIDENED 1.0039063
// Size of geometry without extent, metres: all sizes that follow from it stay within the range of floats.
#define PLACEMENT_SMALLEST 1.0e-30
// Largest finite float.
#define PLACEMENT_LONGEST 3.4028235e+38

// Largest number of pages that the word of a list can address next to the number of their used slots.
#define PAGE_LIMIT 0x0FFFFFFEu

// Maximum number of cells per view that one invocation of a binning builder visits; triangles with more are large.
#define BIN_CELLS 64
// Number of columns along a side of the blocks that an invocation for large triangles visits in turn, if a
// structure can test whether a triangle reaches into a block.
#define BIN_BLOCK 4
// Threads of a workgroup for large triangles, and the maximum number of iterations of the loops of a thread.
#define BIN_GROUP_SIZE 64u
#define BIN_TURNS 30000
// Number of workgroups per row of the dispatch for large triangles.
#define BIN_LARGE_ROW 32768u

// Threads in a workgroup of the pass that builds a pyramid.
#define PYRAMID_THREADS 64u

#endif

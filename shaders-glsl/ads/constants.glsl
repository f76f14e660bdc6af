// Numbers that the shared passes and their recording in Rust share. Only `#define NAME number` may stand
// here.
#ifndef ADS_CONSTANTS_GLSL
#define ADS_CONSTANTS_GLSL

// Maximum number of views that one draw of all triangles covers: the faces of a cube.
#define GEOMETRY_DRAW_VIEWS 6u

// Number of stamps of a geometry whose triangles the device counts. Each time their number changes, the
// geometry takes the next of these stamps, and after the last one the first.
#define GEOMETRY_COUNT_STAMPS 1024u
// Bit of a stamp, one of the bits of STATUS_FLAGS. It is set when the number of triangles changes, until
// their indices are gathered. Meanwhile no status belongs to a build of these triangles.
#define GEOMETRY_NOT_GATHERED 1u

// Sizes in the buffer of a geometry's header, bytes: of the header; of each run of a part, which follow the
// header; and of the map of a part that is built in a space of its own, which lies at a multiple of its size.
#define GEOMETRY_HEADER_BYTES 112u
#define GEOMETRY_RUN_BYTES 8u
#define GEOMETRY_RIGID_BYTES 72u

// Role of a structure in a trace: it is built over all triangles, over the part that is traced first, or over
// a later part, whose trace goes on from the hits that the queue holds of earlier parts.
#define PART_WHOLE 0u
#define PART_FIRST 1u
#define PART_NEXT 2u
// Number added to the role, where surfaces are found, for each part that was traced after this one.
#define PART_AFTER 4u

// Rule for fragments that are as close to an end of the ray as fragments of the surface there are: they count
// (ENDS_TOUCHING), or they do not (ENDS_CLEAR).
#define ENDS_TOUCHING 0u
#define ENDS_CLEAR 1u

// Scans: numbers that one workgroup adds up (a block), threads of the workgroup, and threads whose sums form
// a row.
#define SCAN_BLOCK 1024u
#define SCAN_THREADS 256u
#define SCAN_ROW 16u

// Threads in a workgroup of the passes of a structure's own build.
#define BUILD_GROUP_SIZE 64u

// Threads in a workgroup of the passes that sort lists.
#define SORT_GROUP_SIZE 64u

// Longest list that is sorted in one dispatch. A heap sort of that many elements takes at most 27,000 steps.
#define SHORT_LIST_LIMIT 2048u

// Number of dispatches that sort longer lists, and number of steps that each of them makes in a list. Drivers
// may end all loops of an invocation after 65,535 iterations.
#define LONG_LIST_ROUNDS 16u
#define LONG_LIST_STEPS 60000u

// Long conservative lists are divided into slices by depth: number of slices, least length of a list that is
// divided, and largest, for the same reason.
#define CONSERVATIVE_SLICES 8u
#define CONSERVATIVE_LONG 32u
#define CONSERVATIVE_LONGEST 30000u
// Bit of a node's depths that says that the node is a slice.
#define CONSERVATIVE_SLICE 0x80000000u

// Longest list that these dispatches sort. A heap sort of that many elements takes at most 875,000 steps.
// Longer lists stay unsorted, and are counted.
#define LONG_LIST_LIMIT 50000u

// Longest linked list that is sorted in one dispatch, by ten merge passes, and a number of steps that is
// enough for it.
#define NODE_SORT_LIMIT 1024u
#define NODE_SORT_STEPS 24000u

// Maximum number of linked lists that one thread sorts within that number of steps, since few lists have more
// than one node. At most 32.
#define NODE_SORT_LISTS 16u

// Longest linked list that the dispatches for longer lists sort. Each dispatch counts its nodes and makes one
// merge pass within LONG_LIST_STEPS; 15 passes are enough. Longer lists stay unsorted, and are counted.
#define NODE_SORT_LONG_LIMIT 19000u

// Value in place of the progress of a list that is sorted completely.
#define LONG_LIST_DONE 0xFFFFFFFFu

// Longest list that is searched for a fragment that can represent a triangle which misses the centre of the
// cell. In cells with longer lists every such triangle goes into the conservative list.
#define CONSERVATIVE_LIMIT 4096u

// A fragment represents a triangle that misses the centre of the cell if the distance of the fragment's plane
// from the triangle's nearest point is at most this number, in widths of the cell or of the triangle,
// whichever is smaller.
#define CONSERVATIVE_DEPTH 0.25

// Distance of a ray's origin from the centre of the views, in multiples of the largest distance of the
// geometry, beyond which the ray is tested against every triangle where no hit may be lost: its rounding
// exceeds the margins of the cells near the centre.
#define ORIGIN_LIMIT 4.0

// Bound of the shift by rounding between a triangle and the ray that is marched, divided by the largest
// distance of the geometry from the centre: 24 units of rounding for each of the five distances between
// origin and hit.
#define TRIANGLE_ROUNDING 7.2e-6

// Half side of the near region where no hit may be lost, divided by the number of cells along a side and by
// the largest distance of the geometry from the centre. At the boundary of the region a cell is as wide as
// the rounding guard of the march: 16 units of rounding for each of nine distances.
#define NEAR_REGION 4.8e-6

// Margin within which cells list triangles, divided by the largest distance of the geometry from the centre:
// the rounding of the test in two coordinates (240 units) and that of the march (96 units).
#define CELL_ROUNDING 2.0e-5

// Distance of an eye from the centre, in multiples of the largest distance of the geometry, up to which
// header passes (ads/placement.glsl) need not widen margins or move the centre of views towards the eye. A
// little less than ORIGIN_LIMIT.
#define PLACEMENT_EYE_LIMIT 3.5
// Share of the bounds, on each side, within which no centre of views is placed for an eye outside of the
// bounds: about a quarter, and not a fraction at which a scene is likely to have a wall.
#define PLACEMENT_MARGIN 0.2718
// Share of the bounds, from their lower corner, at which a centre of views lies that does not follow the eye:
// about the middle, and not a fraction at which a scene is likely to have a wall.
#define PLACEMENT_MIDDLE 0.4718
// Ratio of the shortest to the longest side below which bounds are flat: a centre of views among their
// triangles would see all of them edge-on and across many tiles.
#define PLACEMENT_FLATTEST 0.25
// Largest margin of cells along the axes for a distant eye, as a share of a cell.
#define PLACEMENT_WIDEST_MARGIN 0.125
// Number of margins by which cells along the axes reach beyond the bounds: below the lower sides, and above
// the upper ones.
#define PLACEMENT_BELOW 6.0
#define PLACEMENT_ABOVE 10.0
// Ratio of the side of a cube to the longest side of the geometry that the cube holds.
#define PLACEMENT_WIDENED 1.0039063
// Size that geometry without extent is taken to have, metres. All sizes that follow from it stay within the
// range of floats.
#define PLACEMENT_SMALLEST 1.0e-30
// Largest finite float.
#define PLACEMENT_LONGEST 3.4028235e+38

// Largest number of pages that the word of a list can address besides the number of used slots.
#define PAGE_LIMIT 0x0FFFFFFEu

// Maximum number of cells per view that one invocation of a binning builder visits. Triangles with more cells
// are large.
#define BIN_CELLS 64
// Columns along a side of the blocks of cells that an invocation for large triangles takes in turn, if the
// structure can test whether a triangle reaches into a block.
#define BIN_BLOCK 4
// Threads of a workgroup for large triangles, and maximum number of iterations of a thread's loops.
#define BIN_GROUP_SIZE 64u
#define BIN_TURNS 30000
// Number of workgroups in a row of the dispatch for large triangles.
#define BIN_LARGE_ROW 32768u

// Threads in a workgroup of the pass that builds a pyramid.
#define PYRAMID_THREADS 64u

#endif

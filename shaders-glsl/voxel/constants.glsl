// Numbers that the voxels' shaders and crate share. Only `#define NAME number` may stand here.
#ifndef VOXEL_CONSTANTS_GLSL
#define VOXEL_CONSTANTS_GLSL

// Views in which a fragment is kept and in which a voxel is searched: all views keep all fragments; a voxel
// is searched along the axis of its averaged normal.
#define VOXEL_AXES_ALL 0u
// Views of fragments: a view keeps those in voxels whose averaged normal has its axis.
#define VOXEL_AXES_VOXEL 1u
// Views of fragments: a view keeps the triangles that face it most; a voxel is searched along the axes of all
// its triangles.
#define VOXEL_AXES_TRIANGLE 2u

// Marks by which a voxel is occupied: by the fragments in it alone, with all axes, or by the triangles that
// reach into it, in a pass before.
#define VOXEL_MARKED_BY_FRAGMENTS 0u
#define VOXEL_MARKED_BY_TRIANGLES 1u

// Hit of a ray in an occupied voxel: a fragment in it, or the voxel itself, where the ray enters it.
#define VOXEL_LEAVES_FRAGMENTS 0u
#define VOXEL_LEAVES_VOXELS 1u

// Method by which a ray goes from voxel to voxel: one after another, or over the empty nodes of an octree.
#define VOXEL_TRAVERSAL_DDA 0u
#define VOXEL_TRAVERSAL_OCTREE 1u

// Counts that a scan runs over.
#define VOXEL_SCAN_LISTS 0u
#define VOXEL_SCAN_OCTANTS 1u

// Octree: largest number of levels, that of VOXEL_GRID_LIMIT, and number of nodes whose places a node can
// hold.
#define VOXEL_LEVEL_LIMIT 10u
#define VOXEL_NODE_LIMIT 0x1000000u

// Steps of a ray within a voxel.
#define VOXEL_MARCH_SAMPLES 0u
#define VOXEL_MARCH_EXACT 1u

// Distance before the end of a ray at which its search stops, in widths of a cell or a voxel, whichever it hits: the
// fragments of the surface it ends on are within a cell of it.
#define VOXEL_ENDING 2.0

// Fragments that parity counts: all before the point in its cell, or only those at the depths of the voxel.
#define VOXEL_INSIDE_COLUMN 0u
#define VOXEL_INSIDE_VOXEL 1u

// Condition under which a fragment counts as hit.
#define VOXEL_ACCEPT_PARITY 0u
#define VOXEL_ACCEPT_PLANE 1u

// Payload of a fragment in addition to its depth: its triangle; Hu's colour, normal and terms of the material; or
// Selective's colour, reflectivity, normal and triangle.
#define VOXEL_PAYLOAD_INDEX 0u
#define VOXEL_PAYLOAD_MATERIAL 1u
#define VOXEL_PAYLOAD_MIRROR 2u

// Storage of the fragments of a cell: contiguous, after they were counted; linked to one another;
// or in linked pages of several.
#define VOXEL_STORAGE_CONTIGUOUS 0u
#define VOXEL_STORAGE_LINKED 1u
#define VOXEL_STORAGE_PAGED 2u

// Cells that keep a triangle: those whose centre it covers by the rasterizer, or by the shared function; or
// all cells that it reaches into, in which case hits are those of triangles.
#define VOXEL_COVERAGE_HARDWARE 0u
#define VOXEL_COVERAGE_EXACT 1u
#define VOXEL_COVERAGE_CONSERVATIVE 2u

// Maximum voxels along a side: three coordinates share a word of a paused ray.
#define VOXEL_GRID_LIMIT 1024u

// Bits of a voxel: one for each axis along which it is searched, and one for an occupied voxel.
#define VOXEL_OCCUPIED 8u
#define VOXEL_BITS 4u

// Margin by which a voxel counts triangles outside it, in voxels: more than rounding moves a ray.
#define VOXEL_SLACK 0.00390625

// Number of steps of a unit normal's components, which are added up as whole numbers.
#define VOXEL_NORMAL_STEPS 127.0

// Length of a sorted list above which it is entered by bisection.
#define VOXEL_BISECT_FROM 8u

// Number of halvings by which the place of a hit is refined between two points of a ray; at most 8, whose
// outcomes a paused ray keeps.
#define VOXEL_REFINEMENTS 8u

// Reach of a fragment's plane beyond its triangle, in widths of a cell.
#define VOXEL_PLANE_REACH 2.0

// Largest number of fragments of a list that one invocation counts: drivers may end all loops after 65,535
// iterations.
#define VOXEL_LONGEST_LIMIT 60000u

#endif

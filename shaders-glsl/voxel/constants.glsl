// Numbers that the voxels' shaders and crate share. Only `#define NAME number` may stand here.
#ifndef VOXEL_CONSTANTS_GLSL
#define VOXEL_CONSTANTS_GLSL

// Views in which a fragment is kept, and axes along which a voxel is searched. Here all views keep all
// fragments, and a voxel is searched along the axis of its averaged normal.
#define VOXEL_AXES_ALL 0u
// A view keeps the fragments in voxels whose averaged normal is closest to the view's axis; a voxel is
// searched along that axis.
#define VOXEL_AXES_VOXEL 1u
// A view keeps the triangles that face it most; a voxel is searched along the axes of all its triangles.
#define VOXEL_AXES_TRIANGLE 2u

// Source of the marks of occupied voxels: fragments that lie in a voxel, if every view keeps every triangle;
// or triangles that reach into it, in a pass before.
#define VOXEL_MARKED_BY_FRAGMENTS 0u
#define VOXEL_MARKED_BY_TRIANGLES 1u

// Hit of a ray in an occupied voxel: a fragment in the voxel, or the voxel itself, where the ray enters it.
#define VOXEL_LEAVES_FRAGMENTS 0u
#define VOXEL_LEAVES_VOXELS 1u

// Method by which a ray goes from voxel to voxel: one after another, or over the empty nodes of an octree.
#define VOXEL_TRAVERSAL_DDA 0u
#define VOXEL_TRAVERSAL_OCTREE 1u

// Numbers over which a scan runs: lengths of lists, or octants of the octree's nodes that hold something.
#define VOXEL_SCAN_LISTS 0u
#define VOXEL_SCAN_OCTANTS 1u

// Maximum number of levels of the octree, that of VOXEL_GRID_LIMIT, and maximum number of its nodes: a node
// holds the place of another node in 24 bits.
#define VOXEL_LEVEL_LIMIT 10u
#define VOXEL_NODE_LIMIT 0x1000000u

// Steps of a ray within a voxel: samples at equal distances, or all cells that the ray crosses.
#define VOXEL_MARCH_SAMPLES 0u
#define VOXEL_MARCH_EXACT 1u

// Distance before the end of a ray at which its search stops, in widths of the elements that it hits (cells
// or voxels). The fragments of the surface on which the ray ends are within one such width of that surface.
#define VOXEL_ENDING 2.0

// Fragments that parity counts before a point: all in the point's cell, or only those at the depths of the
// point's voxel.
#define VOXEL_INSIDE_COLUMN 0u
#define VOXEL_INSIDE_VOXEL 1u

// Condition under which a ray hits a fragment: the parity of the fragments before the ray changes, or the ray
// meets the plane of the fragment's triangle.
#define VOXEL_ACCEPT_PARITY 0u
#define VOXEL_ACCEPT_PLANE 1u

// Payload of a fragment in addition to its depth: its triangle; Hu's colour, normal and terms of the
// material; or Selective's colour, reflectivity, normal and triangle.
#define VOXEL_PAYLOAD_INDEX 0u
#define VOXEL_PAYLOAD_MATERIAL 1u
#define VOXEL_PAYLOAD_MIRROR 2u

// Storage of the fragments of a cell: contiguous, after a pass counted them; linked to one another; or in
// linked pages of several fragments.
#define VOXEL_STORAGE_CONTIGUOUS 0u
#define VOXEL_STORAGE_LINKED 1u
#define VOXEL_STORAGE_PAGED 2u

// Rule by which cells keep a triangle. Hardware: the rasterizer finds the cell's centre covered. Exact: the
// shared function does. Conservative: the triangle reaches into the cell; rays then hit triangles.
#define VOXEL_COVERAGE_HARDWARE 0u
#define VOXEL_COVERAGE_EXACT 1u
#define VOXEL_COVERAGE_CONSERVATIVE 2u

// Maximum number of voxels along a side: three coordinates share one word of a paused ray.
#define VOXEL_GRID_LIMIT 1024u

// Bit of an occupied voxel, behind the three bits of the axes along which it is searched; and number of bits
// of a voxel.
#define VOXEL_OCCUPIED 8u
#define VOXEL_BITS 4u

// Margin beyond a voxel within which it counts triangles, in voxels. It is larger than the distance by which
// rounding moves a ray.
#define VOXEL_SLACK 0.00390625

// Number of steps of each component of a unit normal. Components are added up as whole numbers of steps.
#define VOXEL_NORMAL_STEPS 127.0

// Length of a sorted list above which a search finds its first fragment by bisection.
#define VOXEL_BISECT_FROM 8u

// Number of halvings by which the place of a hit is refined between two points of a ray. It is at most 8,
// because a paused ray keeps their outcomes in 9 bits.
#define VOXEL_REFINEMENTS 8u

// Distance from its triangle up to which the plane of a fragment is hit, in widths of a cell.
#define VOXEL_PLANE_REACH 2.0

// Maximum number of fragments of a list that one invocation counts. Drivers may end all loops of an
// invocation after 65,535 iterations.
#define VOXEL_LONGEST_LIMIT 60000u

#endif

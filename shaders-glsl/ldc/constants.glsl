// Numbers that the layered depth cube's shaders and crate share. Only `#define NAME number` may stand here.
#ifndef LDC_CONSTANTS_GLSL
#define LDC_CONSTANTS_GLSL

// Condition under which a fragment counts as hit.
#define LDC_ACCEPT_TOLERANCE 0u
#define LDC_ACCEPT_SLOPE 1u
#define LDC_ACCEPT_PLANE 2u
#define LDC_ACCEPT_TRIANGLE 3u

// Cells in which a triangle gets a fragment.
#define LDC_COVERAGE_HARDWARE 0u
#define LDC_COVERAGE_EXACT 1u
#define LDC_COVERAGE_CONSERVATIVE 2u

// Depths that a block stores: only the smallest and the largest in it, or also the slices of the cube's depth
// that it occupies.
#define LDC_OCCUPANCY_BOUNDS 0u
#define LDC_OCCUPANCY_SLICES 1u

// Payload of a fragment: its triangle, or colour and normal of the surface there.
#define LDC_PAYLOAD_INDEX 0u
#define LDC_PAYLOAD_ATTRIBUTES 1u

// Method of making layers: all in one pass and then sorted, or one per pass by peeling.
#define LDC_BUILD_SINGLE 0u
#define LDC_BUILD_PEEL 1u

// Number of slices of a cube's depth: the bits of two words.
#define LDC_SLICES 64u

// Number of blocks along a side of a block of the second level.
#define LDC_LEVEL_BLOCKS 8u

// Reach of a fragment's plane beyond its triangle, in widths of a cell. A triangle has a small slope in the view
// it faces most, so that its plane leaves the cell before that.
#define LDC_PLANE_REACH 2.0

// Largest distance before and behind the ray's segment in its cell at which a fragment's plane counts, in widths of a
// cell. More keeps rays from leaving a curved surface between two cells, less keeps planes from protruding next to it.
#define LDC_PLANE_SLACK 0.125

// Distance of a ray from its origin, in widths of a cell, from which it can hit a plane that it started close to.
#define LDC_LEAVING 2.0

// Distance from the end of a ray within which fragments next to it are part of the surface that it ends on, in widths
// of a cell with the tolerance: a ray that ends at a steeper angle than a seventh has left their depths by then.
#define LDC_ENDING 4.0

// Margin for the rounding of what is subtracted from corner and ray, over the largest coordinate of the geometry.
#define LDC_ROUNDING 4.8e-7

// Extra reach of cells for triangles where the cube is in a space of its own, in cells: rounding may move them as far
// where they are posed. Fragments are where cells have their centres, and may be off by more.
#define LDC_RIGID_REACH 0.001
#define LDC_RIGID_REACH_FRAGMENTS 0.05

#endif

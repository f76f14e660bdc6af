// Numbers that the layered depth cube's shaders and crate share. Only `#define NAME number` may stand here.
#ifndef LDC_CONSTANTS_GLSL
#define LDC_CONSTANTS_GLSL

// Condition under which a ray hits a fragment. Tolerance: the depths of ray and fragment differ by at most a
// fixed tolerance. Slope: they differ by at most half of the triangle's rise over the cell. Plane: the ray
// meets the triangle's plane in the cell. Triangle: the ray hits the triangle.
#define LDC_ACCEPT_TOLERANCE 0u
#define LDC_ACCEPT_SLOPE 1u
#define LDC_ACCEPT_PLANE 2u
#define LDC_ACCEPT_TRIANGLE 3u

// Rule by which cells keep triangles. Hardware: the rasterizer finds the cell's centre covered. Exact: the
// shared function does. Conservative: as exact, and the cell keeps triangles that reach into it.
#define LDC_COVERAGE_HARDWARE 0u
#define LDC_COVERAGE_EXACT 1u
#define LDC_COVERAGE_CONSERVATIVE 2u

// Depths that a block stores: only the smallest and the largest, or also the slices of the cube's depth that
// hold something.
#define LDC_OCCUPANCY_BOUNDS 0u
#define LDC_OCCUPANCY_SLICES 1u

// Payload of a fragment: its triangle, or colour and normal of the surface.
#define LDC_PAYLOAD_INDEX 0u
#define LDC_PAYLOAD_ATTRIBUTES 1u

// Method by which layers are made: all in one pass, which are then sorted, or one per pass by peeling.
#define LDC_BUILD_SINGLE 0u
#define LDC_BUILD_PEEL 1u

// Number of slices of a cube's depth: the bits of two words.
#define LDC_SLICES 64u

// Number of blocks of the first level along a side of a block of the second level.
#define LDC_LEVEL_BLOCKS 8u

// Distance from its triangle up to which the plane of a fragment is hit, in widths of a cell. In the view
// that it faces most, a triangle has a small slope, so its plane leaves the cell before that.
#define LDC_PLANE_REACH 2.0

// Distance before and behind the ray's segment in its cell up to which the plane of a fragment is hit, in
// widths of a cell. A greater distance keeps rays from leaving a curved surface between two cells; a smaller
// one keeps planes from protruding beside the surface.
#define LDC_PLANE_SLACK 0.125

// Distance from its origin, in widths of a cell, from which a ray can hit a plane close to which it started.
#define LDC_LEAVING 2.0

// Distance from the end of a ray within which fragments as deep as the end belong to the surface on which the
// ray ends. The unit is the width of a cell plus the tolerance. A ray that ends at an angle steeper than a
// seventh has left the depths of these fragments by then.
#define LDC_ENDING 4.0

// Margin for the rounding of positions that are made relative to the cube, divided by the geometry's largest
// coordinate.
#define LDC_ROUNDING 4.8e-7

// Extra margin within which cells keep triangles, in cells, if the cube is in a space of its own: rounding
// may move posed triangles as far. The second number is for fragments, which are at centres of cells and may
// be off by more.
#define LDC_RIGID_REACH 0.001
#define LDC_RIGID_REACH_FRAGMENTS 0.05

#endif

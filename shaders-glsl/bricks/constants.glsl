// Numbers that the bricks' shaders and crate share. Only `#define NAME number` may stand here.
#ifndef BRICKS_CONSTANTS_GLSL
#define BRICKS_CONSTANTS_GLSL

// Option: the views, which are the faces of a cube around a centre or one box along the axes of the world.
#define BRICKS_VIEWS_CUBE 0u
#define BRICKS_VIEWS_AXES 1u

// Bit in the word of a brick that marks an empty one: no cell has a list or is divided.
#define BRICKS_EMPTY 0x80000000u
// Maximum number of empty bricks that a step crosses, including the one that the ray is in.
#define BRICKS_REACH 8u

// Bound of the error of a computed point of a ray, divided by the largest distance of the geometry: 16 units
// of rounding.
#define BRICKS_PLACE 9.6e-7

// Largest number of times that a cell is divided into 4x4x4 smaller cells; and number of small triangles in a
// cell's list above which the cell is divided. Small triangles are no longer than the cell along any axis.
#define BRICKS_DEPTH_MOST 3u
#define BRICKS_CROWDED 16u
// Smallest width of smaller cells, in margins. A cell is not divided along an axis in which its parts would
// be narrower.
#define BRICKS_DIVIDED_MARGINS 2.0
// Maximum number of smallest cells along a side of a view: positions of bricks have 16 bits.
#define BRICKS_FINEST_LIMIT 16384u
// Largest number of workgroups of an indirect dispatch. If there is more work, invocations go on with the
// rest.
#define BRICKS_GROUPS_MOST 65535u

// Maximum number of columns along a side of a view, and of slices. Loops over them stay far below the number
// of iterations that drivers allow an invocation.
#define BRICKS_SIDE_LIMIT 1024u
#define BRICKS_SLICE_LIMIT 1024u

// Number of octaves of depth in which triangles are counted; and N, if at most one triangle in N may begin
// nearer than the depths that are divided into slices.
#define BRICKS_OCTAVES 32u
#define BRICKS_OCTAVE_SHARE 256u

// Number of words of the large-triangle queue per triangle: one per view.
#define BRICKS_LARGE_LIMIT 6u

#endif

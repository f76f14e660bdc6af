// Numbers that the bricks' shaders and crate share. Only `#define NAME number` may stand here.
#ifndef BRICKS_CONSTANTS_GLSL
#define BRICKS_CONSTANTS_GLSL

// Views: faces of a cube around a centre, or one box along the axes of the world.
#define BRICKS_VIEWS_CUBE 0u
#define BRICKS_VIEWS_AXES 1u

// Bit in the word of a brick without a cell that has a list.
#define BRICKS_EMPTY 0x80000000u
// Maximum number of empty bricks that one step crosses, its own included.
#define BRICKS_REACH 8u

// Largest error of the computed place of a point of a ray, over the distance of the geometry: 16 units of
// rounding.
#define BRICKS_PLACE 9.6e-7

// Largest number of divisions of a cell into 4x4x4 smaller ones, and number of small triangles that a cell
// lists before it is divided: small triangles are no longer than the cell along any axis.
#define BRICKS_DEPTH_MOST 3u
#define BRICKS_CROWDED 16u
// Least width of smaller cells, in margins: a cell is not divided along an axis where they would be narrower.
#define BRICKS_DIVIDED_MARGINS 2.0
// Maximum number of columns along a side of a view of the smallest cells: positions of bricks have 16 bits.
#define BRICKS_FINEST_LIMIT 16384u
// Largest number of workgroups of an indirect dispatch, whose invocations go on with the rest.
#define BRICKS_GROUPS_MOST 65535u

// Maximum number of columns along a side of a view, and of slices: loops over them stay far below the
// iterations that drivers allow an invocation.
#define BRICKS_SIDE_LIMIT 1024u
#define BRICKS_SLICE_LIMIT 1024u

// Number of octaves of depth in which triangles are counted; and N, if one triangle in N may begin nearer
// than the depths that are divided into slices.
#define BRICKS_OCTAVES 32u
#define BRICKS_OCTAVE_SHARE 256u

// Number of words per triangle of the large-triangle queue: one per view.
#define BRICKS_LARGE_LIMIT 6u

#endif

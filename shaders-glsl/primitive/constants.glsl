// Numbers that the primitive lists' shaders and crate share. Only `#define NAME number` may stand here.
#ifndef PRIMITIVE_CONSTANTS_GLSL
#define PRIMITIVE_CONSTANTS_GLSL

// Option: how the lists of a cell are stored, as linked or as contiguous entries.
#define PRIMITIVE_STORAGE_LINKED 0u
#define PRIMITIVE_STORAGE_CONTIGUOUS 1u

// Option: which cells list a triangle. HARDWARE: those whose centre the rasterizer covers; CONSERVATIVE: all
// that the triangle reaches into; EXTENSION: those that VK_EXT_conservative_rasterization visits.
#define PRIMITIVE_COVERAGE_HARDWARE 0u
#define PRIMITIVE_COVERAGE_CONSERVATIVE 1u
#define PRIMITIVE_COVERAGE_EXTENSION 2u

// Option: which intersections of a ray with a listed triangle are hits. T: all, by their t; TILE: only those
// that lie in the tile that listed the triangle.
#define PRIMITIVE_ACCEPT_T 0u
#define PRIMITIVE_ACCEPT_TILE 1u

// Option: where the search of a tile ends. BEST: at buckets behind the best hit; BUCKET: after the first
// bucket with a hit.
#define PRIMITIVE_STOP_BEST 0u
#define PRIMITIVE_STOP_BUCKET 1u

// Option: which depths a triangle has in a tile. CLIPPED: depths of its plane within the tile and of its
// corners; CORNERS: depths of its plane at the corners of the tile.
#define PRIMITIVE_DEPTHS_CLIPPED 0u
#define PRIMITIVE_DEPTHS_CORNERS 1u

// Option: where a step out of a tile leads. EXACT: over the next boundary; JUMP: half a pixel beyond it.
#define PRIMITIVE_MARCH_EXACT 0u
#define PRIMITIVE_MARCH_JUMP 1u

// Option: blocks of tiles that a ray tries to skip. OFF: none; FINEST and COARSEST: the level of the pyramid
// at which it begins.
#define PRIMITIVE_PYRAMID_OFF 0u
#define PRIMITIVE_PYRAMID_FINEST 1u
#define PRIMITIVE_PYRAMID_COARSEST 2u

// Number of words of the large-triangle queue per triangle: one per face.
#define PRIMITIVE_LARGE_LIMIT 6u

// Option: the centre of the faces. EYE: the eye; SCENE: the eye if it is within the bounds of the geometry,
// else a point within them; FIXED: a point within the bounds for any eye.
#define PRIMITIVE_CENTRE_EYE 0u
#define PRIMITIVE_CENTRE_SCENE 1u
#define PRIMITIVE_CENTRE_FIXED 2u

// Option: the views with tiles, which are the six faces of a cube or the camera's view alone.
#define PRIMITIVE_VIEWS_CUBE 0u
#define PRIMITIVE_VIEWS_CAMERA 1u
// Factor by which points that are transformed into the camera's view are rounded more than differences of
// positions.
#define PRIMITIVE_CAMERA_ROUNDING 1.25

#endif

// Numbers that the primitive lists' shaders and crate share. Only `#define NAME number` may stand here.
#ifndef PRIMITIVE_CONSTANTS_GLSL
#define PRIMITIVE_CONSTANTS_GLSL

// Storage of the lists of a cell.
#define PRIMITIVE_STORAGE_LINKED 0u
#define PRIMITIVE_STORAGE_CONTIGUOUS 1u

// Cells that list a triangle.
#define PRIMITIVE_COVERAGE_HARDWARE 0u
#define PRIMITIVE_COVERAGE_CONSERVATIVE 1u
#define PRIMITIVE_COVERAGE_EXTENSION 2u

// Condition under which a triangle that the ray intersects is a hit: by its t alone, or only inside the tile
// that listed it.
#define PRIMITIVE_ACCEPT_T 0u
#define PRIMITIVE_ACCEPT_TILE 1u

// End of the search of a tile: at buckets behind the best hit, or after the first bucket with a hit.
#define PRIMITIVE_STOP_BEST 0u
#define PRIMITIVE_STOP_BUCKET 1u

// Depths of a triangle in a tile: those of the whole triangle, or of its plane at the corners of the tile.
#define PRIMITIVE_DEPTHS_CLIPPED 0u
#define PRIMITIVE_DEPTHS_CORNERS 1u

// Step of a ray out of a tile: over the next boundary, or half a pixel beyond it.
#define PRIMITIVE_MARCH_EXACT 0u
#define PRIMITIVE_MARCH_JUMP 1u

// Blocks of tiles that a ray compares with first; off if there are none.
#define PRIMITIVE_PYRAMID_OFF 0u
#define PRIMITIVE_PYRAMID_FINEST 1u
#define PRIMITIVE_PYRAMID_COARSEST 2u

// Number of words per triangle for large triangles: one per face.
#define PRIMITIVE_LARGE_LIMIT 6u

// Centre at which the faces touch: at the eye, at the eye within the geometry, or within the geometry
// wherever the eye is.
#define PRIMITIVE_CENTRE_EYE 0u
#define PRIMITIVE_CENTRE_SCENE 1u
#define PRIMITIVE_CENTRE_FIXED 2u

// Views that are drawn: the six faces of a cube, or the camera's view.
#define PRIMITIVE_VIEWS_CUBE 0u
#define PRIMITIVE_VIEWS_CAMERA 1u
// Rounding of points that are turned into the camera's view, over that of differences of positions.
#define PRIMITIVE_CAMERA_ROUNDING 1.25

#endif

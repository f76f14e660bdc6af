// Numbers that the primitive lists' shaders and crate share. Only `#define NAME number` may stand here.
#ifndef PRIMITIVE_CONSTANTS_GLSL
#define PRIMITIVE_CONSTANTS_GLSL

// How the lists of a cell are kept.
#define PRIMITIVE_STORAGE_LINKED 0u
#define PRIMITIVE_STORAGE_CONTIGUOUS 1u

// Which cells list a triangle.
#define PRIMITIVE_COVERAGE_HARDWARE 0u
#define PRIMITIVE_COVERAGE_EXACT 1u

// What a compute pass of the binning builder does with a triangle in a cell.
#define PRIMITIVE_VISIT_BOUNDS 1u
#define PRIMITIVE_VISIT_COUNT 2u
#define PRIMITIVE_VISIT_STORE 3u

// Rays whose origin is farther from the eye than this many times the geometry are tested against every
// triangle: their rounding exceeds what the cells near the eye can bear.
#define PRIMITIVE_ORIGIN_LIMIT 4.0

// Bound of how far rounding moves a triangle against the ray that is marched, over the distance of the
// geometry: 24 units of rounding for each of the five distances between origin and hit.
#define PRIMITIVE_ROUNDING 7.2e-6

// Half side of the near box over tiles times the distance of the geometry: there a cell is as wide as the
// guard of the march, 16 units of rounding for each of nine distances.
#define PRIMITIVE_NEAR 4.8e-6

// Threads in a workgroup of the build's compute passes.
#define PRIMITIVE_GROUP_SIZE 64u

#endif

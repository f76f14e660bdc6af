// The header of bricks.
// Reads, writes: header; shaders that define STRUCTURE_READ_ONLY only read it.
#ifndef BRICKS_HEADER_GLSL
#define BRICKS_HEADER_GLSL

#include "ads/pools.glsl"
#include "bricks/types.glsl"

STRUCTURE_HEADER(Bricks, bricks)
#define BRICKS_HEADER(s) STRUCTURE_HEADER_OF(Bricks, bricks, s)

#endif

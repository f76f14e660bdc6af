// The boxes of a tree of the driver, reached as ads/pools.glsl says.
// Reads, writes: header, boxes: six floats per triangle, the lower corner and the upper one, in units of header.scale around
// header.centre.
#ifndef DRIVER_ACCESSORS_GLSL
#define DRIVER_ACCESSORS_GLSL

#include "driver/header.glsl"

POOL_WORDS(driver, boxes, 1)
#define DRIVER_POOL(s, pool) POOL_WORDS_OF(driver, pool, DRIVER_HEADER(s))

#endif

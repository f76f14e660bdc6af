// Access to the boxes from which the driver builds its tree.
// Reads, writes: header, boxes. ads/pools.glsl says how pools are reached.
// A box is six floats: its lower and its upper corner relative to header.centre, metres multiplied by
// header.scale.
#ifndef DRIVER_ACCESSORS_GLSL
#define DRIVER_ACCESSORS_GLSL

#include "driver/header.glsl"

POOL_WORDS(driver, boxes, 1)
#define DRIVER_POOL(s, pool) POOL_WORDS_OF(driver, pool, DRIVER_HEADER(s))

#endif

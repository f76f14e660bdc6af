// What: the header of a tree of the driver.
// Reads, writes: header.
#ifndef DRIVER_HEADER_GLSL
#define DRIVER_HEADER_GLSL

#include "ads/pools.glsl"
#include "driver/types.glsl"

STRUCTURE_HEADER(Driver, driver)
#define DRIVER_HEADER(s) STRUCTURE_HEADER_OF(Driver, driver, s)

#endif

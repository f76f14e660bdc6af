// The header of a tree of the driver.
// Reads, writes: header.
#ifndef DRIVER_HEADER_GLSL
#define DRIVER_HEADER_GLSL

#include "ads/pools.glsl"
#include "driver/types.glsl"

STRUCTURE_HEADER(Driver, driver)
#define DRIVER_HEADER(s) STRUCTURE_HEADER_OF(Driver, driver, s)

// The power of two by which a positive normal number is from 1 to 2, and at least the smallest normal one.
float driver_scale_of(float x) {
    uint exponent = floatBitsToUint(x) >> 23;
    return uintBitsToFloat(max(254u - min(exponent, 254u), 1u) << 23);
}

#endif

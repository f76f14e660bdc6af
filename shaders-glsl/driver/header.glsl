// The header of a tree of the driver.
// Reads, writes: header.
#ifndef DRIVER_HEADER_GLSL
#define DRIVER_HEADER_GLSL

#include "ads/pools.glsl"
#include "driver/types.glsl"

STRUCTURE_HEADER(Driver, driver)
#define DRIVER_HEADER(s) STRUCTURE_HEADER_OF(Driver, driver, s)

// Returns the power of two that brings a positive normal number between 1 and 2, but at least the smallest
// normal one.
float driver_scale_of(float x) {
    uint exponent = floatBitsToUint(x) >> 23;
    return uintBitsToFloat(max(254u - min(exponent, 254u), 1u) << 23);
}

#endif

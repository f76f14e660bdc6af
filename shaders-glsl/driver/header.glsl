// The header of the driver's tree.
// Reads, writes: header.
#ifndef DRIVER_HEADER_GLSL
#define DRIVER_HEADER_GLSL

#include "ads/pools.glsl"
#include "driver/types.glsl"

STRUCTURE_HEADER(Driver, driver)
#define DRIVER_HEADER(s) STRUCTURE_HEADER_OF(Driver, driver, s)

// Returns the power of two that scales a positive normal number to a number from 1 to 2; at least the
// smallest normal number.
float driver_scale_of(float x) {
    uint exponent = floatBitsToUint(x) >> 23;
    return uintBitsToFloat(max(254u - min(exponent, 254u), 1u) << 23);
}

#endif

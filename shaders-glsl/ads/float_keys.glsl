// Integers in the order of floats, so that integer atomics find the least and the largest. -0 comes just before 0.
// Reads, writes: nothing. Source: the usual flip of the bits of negative floats.
#ifndef ADS_FLOAT_KEYS_GLSL
#define ADS_FLOAT_KEYS_GLSL

uint key_of(float x) {
    uint bits = floatBitsToUint(x);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

float float_of(uint key) {
    return uintBitsToFloat((key & 0x80000000u) != 0u ? key & 0x7FFFFFFFu : ~key);
}

#endif

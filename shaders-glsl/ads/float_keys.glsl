// Maps floats to integers in the same order, so that integer atomics find the smallest and the largest float.
// -0 comes just before 0.
// Reads, writes: nothing.
// Source: the usual flip of the bits of negative floats.
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

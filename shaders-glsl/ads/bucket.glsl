// Turns a depth into a bucket. Builds and traces call the same function.
// Reads, writes: nothing.
// Subtraction of a number, multiplication by a number that is not negative, clamping and truncation are each
// monotone in f32. So da <= d <= db implies bucket(da) <= bucket(d) <= bucket(db) without a margin, if z_min
// and scale are the same bits in build and trace. These functions compute the same bits on every device.
#ifndef ADS_BUCKET_GLSL
#define ADS_BUCKET_GLSL

// Returns the number of buckets per metre; 0 if all depths are nearly equal, which puts all of them into
// bucket 0. Division may round differently in two stages of one device, so the function divides whole
// numbers: 2^32 by the upper 16 bits of the range, rounded up. The result is never too large, and at most
// 2^-14 too small, so the largest depth is in the last bucket. Ranges of 2^110 or more get the scale of the
// largest range below.
float bucket_scale(float z_min, float z_max, uint buckets) {
    precise float range = z_max - z_min;
    if (!(range > z_max * 9.5367432e-7)) {
        return 0.0;
    }
    uint bits = floatBitsToUint(range);
    uint exponent = clamp(bits >> 23, 1u, 236u);
    uint divisor = ((bits & 0x007FFFFFu | 0x00800000u) >> 8) + 1u;
    uint quotient = 0xFFFFFFFFu / divisor;
    // Both factors are exact in f32, and so is the power of two below.
    precise float share = float(quotient) * float(buckets);
    precise float scale = share * uintBitsToFloat((237u - exponent) << 23);
    return scale;
}

uint bucket_of(float z, float z_min, float scale, uint buckets) {
    precise float position = (z - z_min) * scale;
    return uint(clamp(position, 0.0, float(buckets) - 1.0));
}

#endif

// The one function that turns depth into a bucket, for build and trace alike.
// Reads, writes: nothing.
// Subtraction of one number, multiplication by a non-negative one, clamping and truncation are each
// monotone in f32, hence da <= d <= db implies bucket(da) <= bucket(d) <= bucket(db) without an
// epsilon, as long as z_min and scale are the same numbers on both sides: they are, on every device.
#ifndef ADS_BUCKET_GLSL
#define ADS_BUCKET_GLSL

// Returns the number of buckets per metre; 0 if all depths are (nearly) equal, which puts everything into
// bucket 0. Division may differ between two stages of one device, so the reciprocal is that of whole numbers:
// the upper 16 bits of the range, rounded up, divide 2^32. The scale is at most 2^-14 too small, and never
// too large, so the largest depth is in the last bucket. Ranges from 2^110 on take the scale of the largest
// below.
float bucket_scale(float z_min, float z_max, uint buckets) {
    precise float range = z_max - z_min;
    if (!(range > z_max * 9.5367432e-7)) {
        return 0.0;
    }
    uint bits = floatBitsToUint(range);
    uint exponent = clamp(bits >> 23, 1u, 236u);
    uint divisor = ((bits & 0x007FFFFFu | 0x00800000u) >> 8) + 1u;
    uint quotient = 0xFFFFFFFFu / divisor;
    // Both factors are exact, and so is the power of two.
    precise float share = float(quotient) * float(buckets);
    precise float scale = share * uintBitsToFloat((237u - exponent) << 23);
    return scale;
}

uint bucket_of(float z, float z_min, float scale, uint buckets) {
    precise float position = (z - z_min) * scale;
    return uint(clamp(position, 0.0, float(buckets) - 1.0));
}

#endif

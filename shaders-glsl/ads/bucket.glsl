// What: the one function that turns depth into a bucket, for build and trace alike.
// Reads, writes: nothing.
// Subtraction of one number, multiplication by a non-negative one, clamping and truncation are each
// monotone in f32, hence da <= d <= db implies bucket(da) <= bucket(d) <= bucket(db) without an
// epsilon, as long as z_min and scale are the same numbers on both sides.
#ifndef ADS_BUCKET_GLSL
#define ADS_BUCKET_GLSL

// Buckets a metre. 0 where all depths are (nearly) the same: everything is in bucket 0.
float bucket_scale(float z_min, float z_max, uint buckets) {
    precise float range = z_max - z_min;
    precise float scale = float(buckets) / range;
    return range > z_max * 9.5367432e-7 ? scale : 0.0;
}

uint bucket_of(float z, float z_min, float scale, uint buckets) {
    precise float position = (z - z_min) * scale;
    return uint(clamp(position, 0.0, float(buckets) - 1.0));
}

#endif

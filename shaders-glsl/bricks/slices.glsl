// Cuts depths into slices by the bits of the float: quasi-logarithmic, monotone and invertible without rounding.
// Reads, writes: nothing.
// A positive float grows with its bits, so taking a first value from the bits and shifting right is monotone, and the
// boundary below slice k is the float whose bits are first + (k << shift). Within an octave slices are equally thick.
#ifndef BRICKS_SLICES_GLSL
#define BRICKS_SLICES_GLSL

struct BricksSlices {
    int count;            // depths before the first slice belong to it, depths behind the last one to that
    int first;            // bits of the depth at which slice 0 begins
    int shift;            // 23 less the logarithm of the slices an octave
};

int bricks_slice_of(float z, BricksSlices slices) {
    return clamp((floatBitsToInt(max(z, 0.0)) - slices.first) >> slices.shift, 0, slices.count - 1);
}

// Returns the depth of the boundary below slice k, for 0 < k < count.
float bricks_slice_boundary(int k, BricksSlices slices) {
    return intBitsToFloat(slices.first + (k << slices.shift));
}

// Returns the slices whose last one ends behind `farthest` and which cover about `octaves` octaves or more;
// nearer depths are in the first slice.
BricksSlices bricks_slices_over(float farthest, uint octaves, uint count) {
    uint an_octave = 1u << uint(findMSB(max(count / max(octaves, 1u), 1u)));
    int shift = 23 - findMSB(an_octave);
    int first = floatBitsToInt(farthest) - (int(count - 1u) << shift);
    return BricksSlices(int(count), max(first, 0), shift);
}

#endif

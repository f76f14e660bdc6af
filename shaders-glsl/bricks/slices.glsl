// Divides depths into slices by the bits of floats. Slices are nearly logarithmic, and no rounding occurs
// between a depth and its slice.
// Reads, writes: nothing.
// A positive float grows with its bits. So subtracting a first value from the bits and shifting the result
// right is monotone, and the boundary below slice k is the float with the bits first + (k << shift). Within
// an octave all slices have the same thickness.
#ifndef BRICKS_SLICES_GLSL
#define BRICKS_SLICES_GLSL

// The slices of a view. Depths before the first slice belong to the first, depths behind the last slice to
// the last.
struct BricksSlices {
    int count;            // number of slices
    int first;            // bits of the depth at which slice 0 begins
    int shift;            // 23 minus log2 of the number of slices per octave
};

int bricks_slice_of(float z, BricksSlices slices) {
    return clamp((floatBitsToInt(max(z, 0.0)) - slices.first) >> slices.shift, 0, slices.count - 1);
}

// Returns the depth of the boundary below slice k, for 0 < k < count.
float bricks_slice_boundary(int k, BricksSlices slices) {
    return intBitsToFloat(slices.first + (k << slices.shift));
}

// Returns `count` slices. The last one contains `farthest` and ends behind it, and the slices cover at least
// about `octaves` octaves before it. Nearer depths are in the first slice.
BricksSlices bricks_slices_over(float farthest, uint octaves, uint count) {
    uint an_octave = 1u << uint(findMSB(max(count / max(octaves, 1u), 1u)));
    int shift = 23 - findMSB(an_octave);
    int first = floatBitsToInt(farthest) - (int(count - 1u) << shift);
    return BricksSlices(int(count), max(first, 0), shift);
}

#endif

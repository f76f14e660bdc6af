// What: triangles with many columns of a face, which binning builders leave to a pass with a workgroup for each.
// Reads, writes: pairs, header.pairs, header.groups. They are kept where the corners of triangles will be.
#ifndef PRIMITIVE_BIN_PAIRS_GLSL
#define PRIMITIVE_BIN_PAIRS_GLSL

#include "primitive/accessors.glsl"

#ifdef ADDRESSING_ADDRESS
#define PRIMITIVE_PAIRS(s) PrimitiveWordAddress(PRIMITIVE_HEADER(s).triangles_address).words
#else
layout(set = STRUCTURE_SET, binding = 7, scalar) buffer PrimitivePairsBuffer { uint primitive_pair_words[]; };
#define PRIMITIVE_PAIRS(s) primitive_pair_words
#endif

uint bin_pair_capacity(PrimitiveRef s) {
    return PRIMITIVE_PAIR_LIMIT * PRIMITIVE_HEADER(s).triangle_capacity;
}

// Leaves a triangle with many columns of a face to the next pass.
void bin_leave(PrimitiveRef s, uint pair) {
    uint place = atomicAdd(PRIMITIVE_HEADER(s).pairs, 1u);
    if (place >= bin_pair_capacity(s)) {
        return;
    }
    PRIMITIVE_PAIRS(s)[place] = pair;
    atomicMax(PRIMITIVE_HEADER(s).groups[0], min(place + 1u, PRIMITIVE_PAIR_ROW));
    atomicMax(PRIMITIVE_HEADER(s).groups[1], place / PRIMITIVE_PAIR_ROW + 1u);
}

// The pair of a workgroup: the face times the number of triangles, and the triangle. False where there are not so many.
bool bin_left(PrimitiveRef s, uint place, out uint pair) {
    bool left = place < min(PRIMITIVE_HEADER(s).pairs, bin_pair_capacity(s));
    pair = left ? PRIMITIVE_PAIRS(s)[place] : 0u;
    return left;
}

#endif

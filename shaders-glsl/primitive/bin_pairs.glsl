// What: where primitive lists keep the triangles with many columns of a face.
// Reads, writes: pairs, header.pairs, header.groups.
#ifndef PRIMITIVE_BIN_PAIRS_GLSL
#define PRIMITIVE_BIN_PAIRS_GLSL

#include "ads/constants.glsl"
#include "primitive/accessors.glsl"

#ifdef ADDRESSING_ADDRESS
#define PAIR_WORD(s, place) PrimitiveWordAddress(PRIMITIVE_HEADER(s).pairs_address).words[place]
#else
layout(set = STRUCTURE_SET, binding = 6, scalar) buffer PrimitivePairsBuffer { uint primitive_pair_words[]; };
#define PAIR_WORD(s, place) primitive_pair_words[place]
#endif

#define PairRef PrimitiveRef
#define PAIR_HEADER(s) PRIMITIVE_HEADER(s)
#define PAIR_CAPACITY(s) PRIMITIVE_HEADER(s).pair_capacity
#include "ads/bin_pairs.glsl"

#endif

// What: where bricks keep the triangles with many columns of a view: where the corners of triangles will be.
// Reads, writes: pairs, header.pairs, header.groups.
#ifndef BRICKS_BIN_PAIRS_GLSL
#define BRICKS_BIN_PAIRS_GLSL

#include "ads/constants.glsl"
#include "bricks/accessors.glsl"

#ifdef ADDRESSING_ADDRESS
#define PAIR_WORD(s, place) BrickWordAddress(BRICK_HEADER(s).triangles_address).words[place]
#else
layout(set = STRUCTURE_SET, binding = 7, scalar) buffer BrickPairsBuffer { uint brick_pair_words[]; };
#define PAIR_WORD(s, place) brick_pair_words[place]
#endif

#define PairRef BrickRef
#define PAIR_HEADER(s) BRICK_HEADER(s)
#define PAIR_CAPACITY(s) (BRICK_PAIR_LIMIT * BRICK_HEADER(s).triangle_capacity)
#include "ads/bin_pairs.glsl"

#endif

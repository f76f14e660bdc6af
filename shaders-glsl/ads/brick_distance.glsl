// What: how far empty bricks reach towards each octant, found one axis after the other.
// Reads, writes: nothing; build passes read and write words.
// A word of the first pass holds two reaches of 4 bits, towards lower and higher slices; of the second four, of the third
// eight. A reach counts bricks from the own one on, BRICK_REACH at most; 0 is a brick that lists something. The reach
// along two axes is the side of the largest square that is empty, since each column of it must be empty that far.
#ifndef ADS_BRICK_DISTANCE_GLSL
#define ADS_BRICK_DISTANCE_GLSL

#include "ads/bricks.glsl"

// One step along a further axis: the reach so far, and what the brick `k` farther along that axis reaches.
uint brick_reach_with(uint reach, uint k, uint reach_there) {
    return min(reach, max(k, reach_there));
}

// The word of an empty brick from its eight reaches.
uint brick_empty_word(uint reaches) {
    uint word = BRICK_EMPTY;
    for (uint octant = 0u; octant < 8u; octant++) {
        word |= ((reaches >> (4u * octant) & 15u) - 1u) << (3u * octant);
    }
    return word;
}

#endif

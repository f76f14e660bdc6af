// Reaches of empty bricks towards each octant, found one axis after the other.
// Reads, writes: nothing; build passes read and write words.
// A word of the first pass holds two reaches of 4 bits, towards lower and higher slices; of the second four,
// of the third eight. A reach counts bricks from the own one on, BRICKS_REACH at most; 0 is a brick that lists
// something. The reach along two axes is the side of the largest square that is empty, since each column of
// it must be empty that far.
#ifndef BRICKS_DISTANCE_GLSL
#define BRICKS_DISTANCE_GLSL

#include "bricks/words.glsl"

// A line of bricks is traversed once in each direction, with the lengths of the runs that end at the
// brick: nibble v - 1 counts bricks in a row that reach v or more, BRICKS_REACH at most. Before the first
// brick everything is empty.
#define BRICKS_RUNS_BEGIN 0x88888888u

// Returns the runs that end at a brick, from those that end before it and its reach along the axes so far.
uint bricks_runs_with(uint runs, uint reach) {
    uint longer = runs + 0x11111111u - (runs >> 3 & 0x11111111u);
    return reach < BRICKS_REACH ? longer & ((1u << (4u * reach)) - 1u) : longer;
}

// Returns the reach of the brick at which runs end, this axis included: the largest v whose run is v long.
uint bricks_reach_of(uint runs) {
    return uint(bitCount((runs + 0x01234567u) & 0x88888888u));
}

// Returns the word of an empty brick from its eight reaches.
uint bricks_empty_word(uint reaches) {
    uint word = BRICKS_EMPTY;
    for (uint octant = 0u; octant < 8u; octant++) {
        word |= ((reaches >> (4u * octant) & 15u) - 1u) << (3u * octant);
    }
    return word;
}

#endif

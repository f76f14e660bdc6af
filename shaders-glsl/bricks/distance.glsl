// Finds how far bricks are empty towards each octant, one axis after the other.
// Reads, writes: nothing; the build passes read and write the words.
// The reach of a brick in some direction is the number of consecutive empty bricks from the brick itself on,
// at most BRICKS_REACH; it is 0 if the brick is not empty. The first pass stores two reaches of 4 bits in a
// word, towards lower and higher slices. The second pass stores four reaches along slices and columns
// together, the third eight along all axes. A reach along two axes is the side of the largest empty square: a
// square of side v has v consecutive columns, each with a reach of v or more along the first axis. The third
// axis works in the same way.
#ifndef BRICKS_DISTANCE_GLSL
#define BRICKS_DISTANCE_GLSL

#include "bricks/words.glsl"

// A pass goes along each line of bricks once in each direction, and keeps the lengths of eight runs that end
// at the current brick: nibble v - 1 is the number of consecutive bricks, at most BRICKS_REACH, whose reach
// along the earlier axes is v or more. Everything before the first brick counts as empty.
#define BRICKS_RUNS_BEGIN 0x88888888u

// Returns the runs that end at a brick, given the runs that end before it and the brick's reach along the
// earlier axes.
uint bricks_runs_with(uint runs, uint reach) {
    uint longer = runs + 0x11111111u - (runs >> 3 & 0x11111111u);
    return reach < BRICKS_REACH ? longer & ((1u << (4u * reach)) - 1u) : longer;
}

// Returns the reach of the brick at which runs end, this axis included: the largest v for which the run of v
// is at least v long.
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

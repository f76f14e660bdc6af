// What: the large-triangle queue of binning builders: triangles that may reach into more cells of a view than one
// invocation visits. A second pass gives each of them workgroups of its own. The including file defines where the queue
// is stored: PairRef, PAIR_HEADER(s) with pairs and groups, PAIR_WORD(s, place), PAIR_CAPACITY(s).
// Reads, writes: the queue, header.pairs, header.groups.
#ifndef ADS_BIN_PAIRS_GLSL
#define ADS_BIN_PAIRS_GLSL

// Enqueues a pair for the pass for many cells: the view times the number of triangles, and the triangle. Those beyond the
// capacity are counted only.
void bin_enqueue(PairRef s, uint pair) {
    uint place = atomicAdd(PAIR_HEADER(s).pairs, 1u);
    if (place >= PAIR_CAPACITY(s)) {
        return;
    }
    PAIR_WORD(s, place) = pair;
    atomicMax(PAIR_HEADER(s).groups[0], min(place + 1u, BIN_PAIR_ROW));
    atomicMax(PAIR_HEADER(s).groups[1], place / BIN_PAIR_ROW + 1u);
}

// The pair of a workgroup. False where there are not so many.
bool bin_enqueued(PairRef s, uint place, out uint pair) {
    bool is_one = place < min(PAIR_HEADER(s).pairs, PAIR_CAPACITY(s));
    pair = is_one ? PAIR_WORD(s, place) : 0u;
    return is_one;
}

#endif

// What: the large-triangle queue of binning builders: triangles that may reach into more cells of a view than one
// invocation visits. A second pass gives each of them workgroups of its own. The including file defines where the queue
// is stored: PairRef, PAIR_HEADER(s) with pairs and groups, PAIR_WORD(s, place), PAIR_CAPACITY(s).
// Reads, writes: the queue, header.pairs, header.groups.
#ifndef ADS_BIN_PAIRS_GLSL
#define ADS_BIN_PAIRS_GLSL

// Enqueues view * triangle count + triangle for the pass for large triangles. Entries beyond the capacity are only
// counted.
void bin_leave(PairRef s, uint pair) {
    uint place = atomicAdd(PAIR_HEADER(s).pairs, 1u);
    if (place >= PAIR_CAPACITY(s)) {
        return;
    }
    PAIR_WORD(s, place) = pair;
    atomicMax(PAIR_HEADER(s).groups[0], min(place + 1u, BIN_PAIR_ROW));
    atomicMax(PAIR_HEADER(s).groups[1], place / BIN_PAIR_ROW + 1u);
}

// The entry that a workgroup works on. False where the queue has fewer.
bool bin_left(PairRef s, uint place, out uint pair) {
    bool left = place < min(PAIR_HEADER(s).pairs, PAIR_CAPACITY(s));
    pair = left ? PAIR_WORD(s, place) : 0u;
    return left;
}

#endif

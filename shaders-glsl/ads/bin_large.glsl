// The large-triangle queue of binning builders. It holds triangles that may reach into more cells of a view
// than one invocation visits; a later pass gives each of them workgroups of its own.
// Reads, writes: the queue, header.large_demand, header.groups.
// The including file defines where the queue is stored: the reference type LargeRef, LARGE_HEADER(s) with the
// members large_demand and groups, LARGE_WORD(s, place) and LARGE_CAPACITY(s).
#ifndef ADS_BIN_LARGE_GLSL
#define ADS_BIN_LARGE_GLSL

// Enqueues a triangle in a view; the entry is view * number of triangles + number of the triangle. Also
// counts the workgroups of the pass that takes the queue. Entries beyond the capacity are only counted.
void bin_enqueue(LargeRef s, uint entry) {
    uint place = atomicAdd(LARGE_HEADER(s).large_demand, 1u);
    if (place >= LARGE_CAPACITY(s)) {
        return;
    }
    LARGE_WORD(s, place) = entry;
    atomicMax(LARGE_HEADER(s).groups[0], min(place + 1u, BIN_LARGE_ROW));
    atomicMax(LARGE_HEADER(s).groups[1], place / BIN_LARGE_ROW + 1u);
}

// Reads the entry at a place of the queue. Returns false if the queue has fewer entries.
bool bin_enqueued(LargeRef s, uint place, out uint entry) {
    bool is_there = place < min(LARGE_HEADER(s).large_demand, LARGE_CAPACITY(s));
    entry = is_there ? LARGE_WORD(s, place) : 0u;
    return is_there;
}

#endif

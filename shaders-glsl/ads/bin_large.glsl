// The large-triangle queue of binning builders: triangles that may reach into more cells of a view than one
// invocation visits. A second pass gives each of them workgroups of its own. The including file defines where the queue
// is stored: LargeRef, LARGE_HEADER(s) with large_demand and groups, LARGE_WORD(s, place), LARGE_CAPACITY(s).
// Reads, writes: the queue, header.large_demand, header.groups.
#ifndef ADS_BIN_LARGE_GLSL
#define ADS_BIN_LARGE_GLSL

// Enqueues view * triangle count + triangle for the pass for large triangles. Entries beyond the capacity are only
// counted.
void bin_enqueue(LargeRef s, uint entry) {
    uint place = atomicAdd(LARGE_HEADER(s).large_demand, 1u);
    if (place >= LARGE_CAPACITY(s)) {
        return;
    }
    LARGE_WORD(s, place) = entry;
    atomicMax(LARGE_HEADER(s).groups[0], min(place + 1u, BIN_LARGE_ROW));
    atomicMax(LARGE_HEADER(s).groups[1], place / BIN_LARGE_ROW + 1u);
}

// Reads the entry that a workgroup works on; false if the queue has fewer.
bool bin_enqueued(LargeRef s, uint place, out uint entry) {
    bool is_there = place < min(LARGE_HEADER(s).large_demand, LARGE_CAPACITY(s));
    entry = is_there ? LARGE_WORD(s, place) : 0u;
    return is_there;
}

#endif

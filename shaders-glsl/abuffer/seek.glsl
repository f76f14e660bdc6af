// Moves the beginning of a sorted list towards the depths that are searched, where the storage allows it.
// Reads: lists, nodes. Writes: header.corrupted.
// Source: MMRT section 4, comparison of storages. A long contiguous list is bisected. Any other list that can
// be read from either end is left out if it ends before the ray's depths begin.
#ifndef ABUFFER_SEEK_GLSL
#define ABUFFER_SEEK_GLSL

#include "contract/trace_log.glsl"
#include "contract/trace_state.glsl"
#include "abuffer/lists.glsl"

// Returns the depth of a node. The read is counted and logged as the read of a list entry.
float abuffer_probe(AbufferRef s, uint link, inout TraceState state, inout uint work) {
    work++;
    state.entries++;
    float z = abuffer_z(s, link);
    trace_log_visit(STEP_ENTRY, link, 0u, 0u, z, z);
    return z;
}

// Bisects a contiguous list, in at most 32 steps. Returns the link of the first node with z >= low if the
// list is read forward, of the last node with z <= high if it is read backward, and 0 if there is no such
// node.
uint abuffer_halve(AbufferRef s, AbufferCursor cursor, float low, float high, inout TraceState state, inout uint work) {
    uint first = min(cursor.link, cursor.last);
    uint end = max(cursor.link, cursor.last) + 1u;
    uint left = first;
    uint right = end;
    while (left < right) {
        uint middle = left + (right - left) / 2u;
        float z = abuffer_probe(s, middle, state, work);
        if (cursor.backward ? z <= high : z < low) {
            left = middle + 1u;
        } else {
            right = middle;
        }
    }
    if (cursor.backward) {
        return left > first ? left - 1u : 0u;
    }
    return left < end ? left : 0u;
}

// Moves the beginning of a sorted list. Only nodes whose depth is outside [low, high] are skipped.
void abuffer_seek(AbufferRef s, uint list, float low, float high, inout AbufferCursor cursor, inout TraceState state,
    inout uint work) {
    // With buckets, the bounds of the cell were tested before.
    if (cursor.link == 0u || ABUFFER_BUCKETED || !ABUFFER_HAS_FAR_END) {
        return;
    }
    if (ABUFFER_CONTIGUOUS && max(cursor.link, cursor.last) - min(cursor.link, cursor.last) >= ABUFFER_SEEK_LENGTH) {
        cursor.link = abuffer_halve(s, cursor, low, high, state, work);
        return;
    }
    uint end = abuffer_list_begin(s, list, !cursor.backward).link;
    if (end == cursor.link || !abuffer_is_stored(s, end)) {
        return;
    }
    float z = abuffer_probe(s, end, state, work);
    if (cursor.backward ? z > high : z < low) {
        trace_log(STEP_SKIP, SKIP_OUTSIDE, 0u, 0u, low, high);
        cursor.link = 0u;
    }
}

#endif

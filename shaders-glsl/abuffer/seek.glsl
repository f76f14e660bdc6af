// Moves the begin of a sorted list towards the depths that are searched, where the storage allows it.
// Reads: lists, nodes. Writes: nothing.
// Source: MMRT section 4, comparison of storages: long contiguous lists are bisected, and all
// storages but singly linked lists are skipped where they end before the ray's depths begin.
#ifndef ABUFFER_SEEK_GLSL
#define ABUFFER_SEEK_GLSL

#include "contract/trace_log.glsl"
#include "contract/trace_state.glsl"
#include "abuffer/lists.glsl"

// Returns the depth of a node, counted and logged as an entry of its list.
float abuffer_probe(AbufferRef s, uint link, inout TraceState state, inout uint work) {
    work++;
    state.entries++;
    float z = abuffer_z(s, link);
    trace_log_visit(STEP_ENTRY, link, 0u, 0u, z, z);
    return z;
}

// Finds the first node of a contiguous list, read forward, with z >= low, or the last one, read backward,
// with z <= high; 0 if there is none. At most 32 steps.
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

// Moves the begin of a sorted list. Only nodes outside [low, high] are skipped.
void abuffer_seek(AbufferRef s, uint list, float low, float high, inout AbufferCursor cursor, inout TraceState state,
    inout uint work) {
    // With buckets, the cell's bounds were tested before.
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

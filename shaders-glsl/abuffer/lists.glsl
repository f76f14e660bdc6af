// The lists of a cell, in one of several storages: how a fragment is put into one, and how one is
// read from either end.
// Reads, writes: lists, nodes, header.demand, header.corrupted.
// Source: MMRT section 3.3 and table 2. Linked: a head, doubly linked also a tail, of each bucket. Contiguous: a
// first place of each cell, and behind all of those the counts. Paged: the word that leads to the first page.
#ifndef ABUFFER_LISTS_GLSL
#define ABUFFER_LISTS_GLSL

#include "ads/constants.glsl"
#include "abuffer/list_pages.glsl"

// Returns the running index of the list of a cell's bucket. Storages without buckets have one bucket.
uint abuffer_list(uint cell, uint bucket) {
    return cell * ABUFFER_BUCKETS + bucket;
}

uint abuffer_list_count(AbufferRef s) {
    return abuffer_cell_count(s) * ABUFFER_BUCKETS;
}

// Returns the number of words of the scratch pool that the scan takes.
uint abuffer_scan_words(AbufferRef s) {
    return ABUFFER_CONTIGUOUS ? (abuffer_list_count(s) + SCAN_BLOCK - 1u) / SCAN_BLOCK : 0u;
}

// Returns the word of a linked list's head; a tail is the next word.
uint abuffer_head_word(uint list) {
    return ABUFFER_DOUBLY ? 2u * list : list;
}

// Returns the links of the first and the last node of a contiguous list, zeros if it is empty. Nodes past the
// end of the pool are counted and left out.
uvec2 abuffer_ends(AbufferRef s, uint list) {
    uint first = ABUFFER_POOL(s, lists)[list];
    uint count = ABUFFER_POOL(s, lists)[abuffer_list_count(s) + list];
    uint stored = abuffer_stored(s);
    if (count == 0u) {
        return uvec2(0u);
    }
    if (first >= stored || count > stored - first) {
        atomicAdd(ABUFFER_HEADER(s).corrupted, 1u);
        return uvec2(0u);
    }
    return uvec2(first + 1u, first + count);
}

// Adds one to the length of a contiguous list, before the scan that turns lengths into places.
void abuffer_count_one(AbufferRef s, uint list) {
    atomicAdd(ABUFFER_POOL(s, lists)[list], 1u);
}

// Takes a node for a fragment of a list; 0 beyond the capacity, which is counted.
uint abuffer_allocate(AbufferRef s, uint list) {
    uint node = 0u;
    if (ABUFFER_PAGED) {
        return abuffer_page_allocate(s, list);
    }
    if (ABUFFER_CONTIGUOUS) {
        uint count = abuffer_list_count(s);
        node = ABUFFER_POOL(s, lists)[list] + atomicAdd(ABUFFER_POOL(s, lists)[count + list], 1u);
        uint end = list + 1u < count ? ABUFFER_POOL(s, lists)[list + 1u] : ABUFFER_HEADER(s).demand;
        if (node >= end) {
            // More fragments than the count pass found would overwrite another list.
            atomicAdd(ABUFFER_HEADER(s).corrupted, 1u);
            return 0u;
        }
    } else {
        node = atomicAdd(ABUFFER_HEADER(s).demand, 1u);
    }
    return node < ABUFFER_HEADER(s).capacity ? node + 1u : 0u;
}

// Puts a node with its depth into its list; in a linked list, at the front. Nodes start out zeroed, so `prev`
// of the newest is 0. The only writer of the old head's `prev` is the thread that replaced it, and the only
// writer of the tail is the thread that found the list empty.
void abuffer_push(AbufferRef s, uint list, uint link, float z) {
    abuffer_set_z(s, link, z);
    if (ABUFFER_CONTIGUOUS || ABUFFER_PAGED) {
        return;
    }
    uint word = abuffer_head_word(list);
    uint old = atomicExchange(ABUFFER_POOL(s, lists)[word], link);
    abuffer_set_next(s, link, old);
    if (!ABUFFER_DOUBLY) {
        return;
    }
    if (old == 0u) {
        ABUFFER_POOL(s, lists)[word + 1u] = link;
    } else {
        abuffer_set_prev(s, old, link);
    }
}

// Cursor of a list that is being read.
struct AbufferCursor {
    uint link;            // the next node; 0 at the end
    uint last;            // the node that ends the list, contiguous only
    bool backward;        // towards the eye where the list is sorted
};

// Begins a list at its far end (if it has one) or at its near end.
AbufferCursor abuffer_list_begin(AbufferRef s, uint list, bool backward) {
    if (ABUFFER_CONTIGUOUS) {
        uvec2 ends = abuffer_ends(s, list);
        return backward ? AbufferCursor(ends.y, ends.x, true) : AbufferCursor(ends.x, ends.y, false);
    }
    if (ABUFFER_PAGED) {
        return AbufferCursor(page_link(s, ABUFFER_POOL(s, lists)[list]), 0u, false);
    }
    uint word = abuffer_head_word(list);
    return AbufferCursor(ABUFFER_POOL(s, lists)[backward ? word + 1u : word], 0u, backward);
}

// Resumes a list that has been read up to `link`.
AbufferCursor abuffer_list_resume(AbufferRef s, uint list, bool backward, uint link) {
    AbufferCursor cursor = AbufferCursor(link, 0u, backward);
    if (ABUFFER_CONTIGUOUS) {
        cursor.last = abuffer_list_begin(s, list, backward).last;
    }
    return cursor;
}

// True if a link refers to a node that was stored; a link that does not is counted.
bool abuffer_is_stored(AbufferRef s, uint link) {
    if (link - 1u < abuffer_stored(s)) {
        return true;
    }
    atomicAdd(ABUFFER_HEADER(s).corrupted, 1u);
    return false;
}

// Returns the next node of a list that has not ended. A link past the end is counted, ends the list and gives
// 0.
uint abuffer_list_next(AbufferRef s, inout AbufferCursor cursor) {
    uint link = cursor.link;
    if (!abuffer_is_stored(s, link)) {
        cursor.link = 0u;
        return 0u;
    }
    if (ABUFFER_CONTIGUOUS) {
        cursor.link = link == cursor.last ? 0u : (cursor.backward ? link - 1u : link + 1u);
    } else if (ABUFFER_PAGED) {
        cursor.link = page_link_behind(s, link);
    } else {
        cursor.link = cursor.backward ? abuffer_prev(s, link) : abuffer_next(s, link);
    }
    return link;
}

// Skips the nodes after a node in its order: the rest of the list, or of the page if only pages are sorted.
void abuffer_list_skip(AbufferRef s, uint link, inout AbufferCursor cursor) {
    cursor.link = ABUFFER_PAGED ? page_link_of_next(s, link) : 0u;
}

#endif

// Puts fragments into the lists of a cell, and reads a list from either end, in each of several storages.
// Reads, writes: lists, nodes, header.demand, header.corrupted.
// Source: MMRT section 3.3 and table 2.
// The pool of lists depends on the storage. Linked: the head of each bucket's list; doubly linked: its head
// and its tail. Contiguous: the first place of each cell's list, and behind all of these the lengths. Paged:
// for each bucket the word that leads to the first page.
#ifndef ABUFFER_LISTS_GLSL
#define ABUFFER_LISTS_GLSL

#include "ads/constants.glsl"
#include "abuffer/list_pages.glsl"

// Returns the running index of the list of a cell's bucket. In a storage without buckets each cell has one.
uint abuffer_list(uint cell, uint bucket) {
    return cell * ABUFFER_BUCKETS + bucket;
}

uint abuffer_list_count(AbufferRef s) {
    return abuffer_cell_count(s) * ABUFFER_BUCKETS;
}

// Returns the number of words at the front of the scratch pool that hold the sums of the scan.
uint abuffer_scan_words(AbufferRef s) {
    return ABUFFER_CONTIGUOUS ? (abuffer_list_count(s) + SCAN_BLOCK - 1u) / SCAN_BLOCK : 0u;
}

// Returns the word that holds the head of a linked list. Its tail, if it has one, is in the next word.
uint abuffer_head_word(uint list) {
    return ABUFFER_DOUBLY ? 2u * list : list;
}

// Returns the links of the first and the last node of a contiguous list, or zeros if the list is empty. A
// list that reaches beyond the end of the pool is counted as corrupted and treated as empty.
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

// Adds one to the length of a contiguous list. The scan turns lengths into places afterwards.
void abuffer_count_one(AbufferRef s, uint list) {
    atomicAdd(ABUFFER_POOL(s, lists)[list], 1u);
}

// Takes a node for a fragment of a list and returns its link. Beyond the capacity the fragment is only
// counted, and the link is 0.
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
// of the newest node is 0. No word has two writers: `prev` of the old head is written only by the thread that
// replaced the head, and the tail only by the thread that found the list empty.
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
    uint link;            // link of the next node; 0 at the end
    uint last;            // link of the node that ends the list; contiguous only
    bool backward;        // from the far end of the list, towards the eye if it is sorted
};

// Returns a cursor at the near end of a list or, with `backward`, at its far end, which ABUFFER_HAS_FAR_END
// says exists.
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

// Returns a cursor that goes on at `link` in a list that was read up to there.
AbufferCursor abuffer_list_resume(AbufferRef s, uint list, bool backward, uint link) {
    AbufferCursor cursor = AbufferCursor(link, 0u, backward);
    if (ABUFFER_CONTIGUOUS) {
        cursor.last = abuffer_list_begin(s, list, backward).last;
    }
    return cursor;
}

// True if a link refers to a node that was stored. Any other link is counted as corrupted.
bool abuffer_is_stored(AbufferRef s, uint link) {
    if (link - 1u < abuffer_stored(s)) {
        return true;
    }
    atomicAdd(ABUFFER_HEADER(s).corrupted, 1u);
    return false;
}

// Returns the link of the next node of a list that has not ended. A link beyond the end of the pool is
// counted as corrupted, ends the list and gives 0.
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

// Skips the nodes that are sorted behind a node: the rest of the list or, with pages, the rest of the page,
// since only the nodes within a page are sorted.
void abuffer_list_skip(AbufferRef s, uint link, inout AbufferCursor cursor) {
    cursor.link = ABUFFER_PAGED ? page_link_of_next(s, link) : 0u;
}

#endif

// One fragment: the words of its node and of its payload. A link is a node's number + 1; 0 is none. Nodes in
// pages are numbered over all slots.
// Reads, writes: nodes, data, header.demand.
// Source: MMRT section 3.3 and table 2. Decoupled payload lies in a pool of its own, inline payload between a
// node's depth and its links.
#ifndef ABUFFER_NODES_GLSL
#define ABUFFER_NODES_GLSL

#include "abuffer/accessors.glsl"

// Returns the number of nodes that were stored; for pages the number of all slots.
uint abuffer_stored(AbufferRef s) {
    return min(ABUFFER_HEADER(s).capacity, ABUFFER_HEADER(s).demand) * ABUFFER_PAGE_SLOTS;
}

uint abuffer_node_word(uint link) {
    uint slot = link - 1u;
    return slot / ABUFFER_PAGE_SLOTS * ABUFFER_PAGE_STRIDE + ABUFFER_PAGE_WORDS
        + slot % ABUFFER_PAGE_SLOTS * ABUFFER_NODE_STRIDE;
}

// Returns the depth at the cell's centre, metres.
float abuffer_z(AbufferRef s, uint link) {
    return uintBitsToFloat(ABUFFER_POOL(s, nodes)[abuffer_node_word(link)]);
}

void abuffer_set_z(AbufferRef s, uint link, float z) {
    ABUFFER_POOL(s, nodes)[abuffer_node_word(link)] = floatBitsToUint(z);
}

// Returns the link away from the eye, of linked nodes.
uint abuffer_next(AbufferRef s, uint link) {
    return ABUFFER_POOL(s, nodes)[abuffer_node_word(link) + ABUFFER_LINK_WORD];
}

void abuffer_set_next(AbufferRef s, uint link, uint next) {
    ABUFFER_POOL(s, nodes)[abuffer_node_word(link) + ABUFFER_LINK_WORD] = next;
}

// Returns the link towards the eye, of nodes that link both ways.
uint abuffer_prev(AbufferRef s, uint link) {
    return ABUFFER_POOL(s, nodes)[abuffer_node_word(link) + ABUFFER_LINK_WORD + 1u];
}

void abuffer_set_prev(AbufferRef s, uint link, uint prev) {
    ABUFFER_POOL(s, nodes)[abuffer_node_word(link) + ABUFFER_LINK_WORD + 1u] = prev;
}

// Returns a word of a fragment's payload. A contiguous node whose payload is past the end is counted and
// gives 0.
uint abuffer_data(AbufferRef s, uint link, uint word) {
    if (ABUFFER_INLINE != 0u) {
        return ABUFFER_POOL(s, nodes)[abuffer_node_word(link) + 1u + word];
    }
    uint place = link - 1u;
    if (ABUFFER_CONTIGUOUS) {
        place = ABUFFER_POOL(s, nodes)[abuffer_node_word(link) + 1u];
        if (place >= abuffer_stored(s)) {
            atomicAdd(ABUFFER_HEADER(s).corrupted, 1u);
            return 0u;
        }
    }
    return ABUFFER_POOL(s, data)[place * ABUFFER_DATA_STRIDE + word];
}

// Stores a word of payload, before anything is sorted: until then payload and node have the same number.
void abuffer_set_data(AbufferRef s, uint link, uint word, uint value) {
    if (ABUFFER_INLINE != 0u) {
        ABUFFER_POOL(s, nodes)[abuffer_node_word(link) + 1u + word] = value;
        return;
    }
    if (ABUFFER_CONTIGUOUS) {
        ABUFFER_POOL(s, nodes)[abuffer_node_word(link) + 1u] = link - 1u;
    }
    ABUFFER_POOL(s, data)[(link - 1u) * ABUFFER_DATA_STRIDE + word] = value;
}

// Returns the words of a fragment's payload; zeros after its last word.
uvec4 abuffer_payload(AbufferRef s, uint link) {
    uvec4 words = uvec4(0u);
    for (uint word = 0u; word < ABUFFER_PAYLOAD_WORDS; word++) {
        words[word] = abuffer_data(s, link, word);
    }
    return words;
}

// True if the left fragment's payload has the lower words, by the first that differ. These are nearly always
// the first of all, so that a loop that ends there costs less than an unrolled one. Sorts cannot use it:
// their steps leave no budget for further iterations.
bool abuffer_payload_is_lower(AbufferRef s, uint left, uint right) {
    bool lower = false;
    bool equal = true;
    [[dont_unroll]] for (uint word = 0u; equal && word < ABUFFER_PAYLOAD_WORDS; word++) {
        uint left_word = abuffer_data(s, left, word);
        uint right_word = abuffer_data(s, right, word);
        equal = left_word == right_word;
        lower = left_word < right_word;
    }
    return lower;
}

// True if the left node comes first in sorted lists: by depth, ties by the first word of payload. Hits do not
// depend on the order of ties.
bool abuffer_comes_first(AbufferRef s, uint left, uint right) {
    float left_z = abuffer_z(s, left);
    float right_z = abuffer_z(s, right);
    return left_z < right_z || (left_z == right_z && abuffer_data(s, left, 0u) <= abuffer_data(s, right, 0u));
}

#endif

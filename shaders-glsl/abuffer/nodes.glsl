// Reads and writes one fragment: the words of its node and of its payload.
// Reads: header. Reads, writes: nodes, data, header.corrupted.
// Source: MMRT section 3.3 and table 2. Decoupled payload lies in a pool of its own; inline payload lies
// between a node's depth and its links.
// A link is the number of a node + 1, and 0 is no node. With pages, nodes are numbered over the slots of all
// pages.
#ifndef ABUFFER_NODES_GLSL
#define ABUFFER_NODES_GLSL

#include "abuffer/accessors.glsl"

// Returns the number of nodes that were stored; with pages, the number of slots of all stored pages.
uint abuffer_stored(AbufferRef s) {
    return min(ABUFFER_HEADER(s).capacity, ABUFFER_HEADER(s).demand) * ABUFFER_PAGE_SLOTS;
}

// Returns the first word of a node.
uint abuffer_node_word(uint link) {
    uint slot = link - 1u;
    return slot / ABUFFER_PAGE_SLOTS * ABUFFER_PAGE_STRIDE + ABUFFER_PAGE_WORDS
        + slot % ABUFFER_PAGE_SLOTS * ABUFFER_NODE_STRIDE;
}

// Returns the depth of a node at the centre of its cell, metres.
float abuffer_z(AbufferRef s, uint link) {
    return uintBitsToFloat(ABUFFER_POOL(s, nodes)[abuffer_node_word(link)]);
}

void abuffer_set_z(AbufferRef s, uint link, float z) {
    ABUFFER_POOL(s, nodes)[abuffer_node_word(link)] = floatBitsToUint(z);
}

// Returns the link of the next node in a linked list, away from the eye if the list is sorted.
uint abuffer_next(AbufferRef s, uint link) {
    return ABUFFER_POOL(s, nodes)[abuffer_node_word(link) + ABUFFER_LINK_WORD];
}

void abuffer_set_next(AbufferRef s, uint link, uint next) {
    ABUFFER_POOL(s, nodes)[abuffer_node_word(link) + ABUFFER_LINK_WORD] = next;
}

// Returns the link of the node before in a doubly linked list, towards the eye if the list is sorted.
uint abuffer_prev(AbufferRef s, uint link) {
    return ABUFFER_POOL(s, nodes)[abuffer_node_word(link) + ABUFFER_LINK_WORD + 1u];
}

void abuffer_set_prev(AbufferRef s, uint link, uint prev) {
    ABUFFER_POOL(s, nodes)[abuffer_node_word(link) + ABUFFER_LINK_WORD + 1u] = prev;
}

// Returns a word of a fragment's payload. If a contiguous node refers beyond the end of the payloads, the
// node is counted as corrupted and the word is 0.
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

// Stores a word of a fragment's payload. In contiguous storage this works only before lists are sorted, while
// a payload has the same number as its node.
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

// Returns the words of a fragment's payload, with zeros behind the last one.
uvec4 abuffer_payload(AbufferRef s, uint link) {
    uvec4 words = uvec4(0u);
    for (uint word = 0u; word < ABUFFER_PAYLOAD_WORDS; word++) {
        words[word] = abuffer_data(s, link, word);
    }
    return words;
}

// True if the payload of the left fragment has the lower words, by the first word that differs. That is
// nearly always word 0, so a loop that ends there costs less than an unrolled one. Sorts cannot use this
// function: their steps leave no budget for further iterations.
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

// True if the left node comes first in sorted lists: by depth, at equal depth by the first word of payload.
// Hits do not depend on the order of nodes of equal depth.
bool abuffer_comes_first(AbufferRef s, uint left, uint right) {
    float left_z = abuffer_z(s, left);
    float right_z = abuffer_z(s, right);
    return left_z < right_z || (left_z == right_z && abuffer_data(s, left, 0u) <= abuffer_data(s, right, 0u));
}

#endif

// Exchanges two nodes in place, for storages in which the places of nodes give their order.
// Reads, writes: nodes; with pages also data.
#ifndef ABUFFER_EXCHANGE_GLSL
#define ABUFFER_EXCHANGE_GLSL

#include "abuffer/nodes.glsl"

void abuffer_exchange(AbufferRef s, uint left, uint right) {
    uint left_word = abuffer_node_word(left);
    uint right_word = abuffer_node_word(right);
    for (uint word = 0u; word < ABUFFER_NODE_STRIDE; word++) {
        uint value = ABUFFER_POOL(s, nodes)[left_word + word];
        ABUFFER_POOL(s, nodes)[left_word + word] = ABUFFER_POOL(s, nodes)[right_word + word];
        ABUFFER_POOL(s, nodes)[right_word + word] = value;
    }
    // A contiguous node takes the reference to its payload along. In pages a payload has the number of its
    // node, so decoupled payloads are exchanged, too.
    if (ABUFFER_PAGED && ABUFFER_INLINE == 0u) {
        for (uint word = 0u; word < ABUFFER_DATA_STRIDE; word++) {
            uint value = abuffer_data(s, left, word);
            abuffer_set_data(s, left, word, abuffer_data(s, right, word));
            abuffer_set_data(s, right, word, value);
        }
    }
}

#endif

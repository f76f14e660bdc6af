// What: sorts a linked list in place by merging the ascending runs it consists of, two and two, until one is left.
// Reads, writes: lists, nodes.
// Source: MMRT section 3.3, reorder pass; Knuth 1998, section 5.2.4, natural merges. The paper's private array, whose
// length cut longer lists short, is not needed: only links change.
// Everything is one loop of bounded length: drivers may end all loops of an invocation after 65,535 iterations,
// and invocations that run side by side pay for the longest of each loop.
#ifndef ABUFFER_SORT_LINKED_GLSL
#define ABUFFER_SORT_LINKED_GLSL

#include "abuffer/lists.glsl"
#include "abuffer/sort.glsl"

// One pass over a list that merges neighbouring runs.
struct AbufferMerge {
    uint left;            // the rest of two runs that are being merged
    uint right;
    bool left_ended;
    bool right_ended;
    uint head;            // of what has been merged
    uint tail;
    uint runs;            // pairs begun
    bool finding;         // where the left run ends is still being looked for
    uint at;              // its last node so far
};

void abuffer_merge_pair(uint begin, inout AbufferMerge merge) {
    merge.left = begin;
    merge.at = begin;
    merge.finding = true;
    merge.left_ended = false;
    merge.right_ended = false;
    merge.runs++;
}

void abuffer_merge_begin(uint head, inout AbufferMerge merge) {
    merge.head = 0u;
    merge.tail = 0u;
    merge.runs = 0u;
    abuffer_merge_pair(head, merge);
}

// Moves the first node of one of the two runs behind what has been merged.
void abuffer_merge_take(AbufferRef s, inout AbufferMerge merge) {
    bool take_left = merge.right_ended || (!merge.left_ended && abuffer_comes_first(s, merge.left, merge.right));
    uint taken = take_left ? merge.left : merge.right;
    uint next = abuffer_next(s, taken);
    if (take_left) {
        merge.left_ended = taken == merge.at;
        merge.left = next;
    } else {
        merge.right_ended = next == 0u || !abuffer_comes_first(s, taken, next);
        merge.right = next;
    }
    if (merge.tail == 0u) {
        merge.head = taken;
    } else {
        abuffer_set_next(s, merge.tail, taken);
    }
    if (abuffer_doubly()) {
        abuffer_set_prev(s, taken, merge.tail);
    }
    merge.tail = taken;
}

// Sorts as far as `steps` go, whole passes at a time: in between the list is whole. Lists of more than `limit` nodes
// stay as they are.
uint abuffer_sort_linked(AbufferRef s, uint list, uint limit, uint steps) {
    uint word = abuffer_head_word(list);
    uint head = ABUFFER_LISTS(s)[word];
    uint count = 0u;
    uint counted = head;
    bool counting = true;
    AbufferMerge merge;
    abuffer_merge_begin(head, merge);
    for (uint i = 0u; i < steps; i++) {
        if (counting) {
            counting = counted != 0u;
            if (counting) {
                counted = abuffer_next(s, counted);
                count++;
            }
            if (count > limit) {
                return SORT_TOO_LONG;
            }
            if (!counting && count < 2u) {
                return SORT_DONE;
            }
        } else if (merge.finding) {
            uint next = abuffer_next(s, merge.at);
            if (next != 0u && abuffer_comes_first(s, merge.at, next)) {
                merge.at = next;
                continue;
            }
            merge.finding = false;
            merge.right = next;
            merge.right_ended = next == 0u;
            // A single run: the list is sorted, and its backward links are taken along.
            if (merge.right_ended && merge.runs == 1u && !abuffer_doubly()) {
                return SORT_DONE;
            }
        } else {
            abuffer_merge_take(s, merge);
            if (!merge.left_ended || !merge.right_ended) {
                continue;
            }
            // What follows both runs stands behind the right one, or nothing where there was none.
            if (merge.right != 0u) {
                abuffer_merge_pair(merge.right, merge);
                continue;
            }
            abuffer_set_next(s, merge.tail, 0u);
            ABUFFER_LISTS(s)[word] = merge.head;
            if (abuffer_doubly()) {
                ABUFFER_LISTS(s)[word + 1u] = merge.tail;
            }
            if (merge.runs == 1u) {
                return SORT_DONE;
            }
            // A pass finds the end of every other run and moves every node.
            if (i + 1u + 2u * count + 2u > steps) {
                return SORT_MORE;
            }
            abuffer_merge_begin(merge.head, merge);
        }
    }
    return SORT_MORE;
}

#endif

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

// A list that is being sorted, step by step.
struct AbufferSort {
    uint list;
    uint count;           // its nodes, as far as they have been counted
    uint counted;         // the next one to be counted
    bool counting;
    AbufferMerge merge;
};

AbufferSort abuffer_sort_begin(AbufferRef s, uint list) {
    AbufferSort sort;
    uint head = ABUFFER_LISTS(s)[abuffer_head_word(list)];
    sort.list = list;
    sort.count = 0u;
    sort.counted = head;
    sort.counting = true;
    abuffer_merge_begin(head, sort.merge);
    return sort;
}

// Steps that suffice for a list: it is counted, and each pass finds the ends of runs and moves nodes, halving the runs.
uint abuffer_sort_cost(uint count) {
    uint passes = count < 2u ? 0u : max(1u, uint(findMSB(count - 1u)) + 1u);
    return count + 1u + passes * (2u * count + 2u);
}

// One step. Between passes the list is whole.
uint abuffer_sort_step(AbufferRef s, inout AbufferSort sort) {
    if (sort.counting) {
        if (sort.counted == 0u) {
            sort.counting = false;
            return SORT_COUNTED;
        }
        sort.counted = abuffer_next(s, sort.counted);
        sort.count++;
        return SORT_STEPPED;
    }
    if (sort.merge.finding) {
        uint next = abuffer_next(s, sort.merge.at);
        if (next != 0u && abuffer_comes_first(s, sort.merge.at, next)) {
            sort.merge.at = next;
            return SORT_STEPPED;
        }
        sort.merge.finding = false;
        sort.merge.right = next;
        sort.merge.right_ended = next == 0u;
        // A single run: the list is sorted, and its backward links are taken along.
        return sort.merge.right_ended && sort.merge.runs == 1u && !abuffer_doubly() ? SORT_DONE : SORT_STEPPED;
    }
    abuffer_merge_take(s, sort.merge);
    if (!sort.merge.left_ended || !sort.merge.right_ended) {
        return SORT_STEPPED;
    }
    // What follows both runs stands behind the right one, or nothing where there was none.
    if (sort.merge.right != 0u) {
        abuffer_merge_pair(sort.merge.right, sort.merge);
        return SORT_STEPPED;
    }
    abuffer_set_next(s, sort.merge.tail, 0u);
    uint word = abuffer_head_word(sort.list);
    ABUFFER_LISTS(s)[word] = sort.merge.head;
    if (abuffer_doubly()) {
        ABUFFER_LISTS(s)[word + 1u] = sort.merge.tail;
    }
    if (sort.merge.runs == 1u) {
        return SORT_DONE;
    }
    abuffer_merge_begin(sort.merge.head, sort.merge);
    return SORT_PASSED;
}

// Sorts as far as `steps` go, whole passes at a time. Lists of more than `limit` nodes stay as they are.
uint abuffer_sort_linked(AbufferRef s, uint list, uint limit, uint steps) {
    AbufferSort sort = abuffer_sort_begin(s, list);
    for (uint i = 0u; i < steps; i++) {
        uint result = abuffer_sort_step(s, sort);
        if (sort.count > limit) {
            return SORT_TOO_LONG;
        }
        if (result == SORT_DONE || (result == SORT_COUNTED && sort.count < 2u)) {
            return SORT_DONE;
        }
        // A pass finds the end of every other run and moves every node.
        if (result == SORT_PASSED && i + 1u + 2u * sort.count + 2u > steps) {
            return SORT_MORE;
        }
    }
    return SORT_MORE;
}

// Whether there is anything to sort.
bool abuffer_sort_has_two(AbufferRef s, uint list) {
    uint head = ABUFFER_LISTS(s)[abuffer_head_word(list)];
    return head != 0u && abuffer_next(s, head) != 0u;
}

// Sorts the lists first, first + stride, ... that a set names by bits, one after the other. The set of those that stay as they
// are, for they are longer than ABUFFER_SORT_LIMIT, or ABUFFER_SORT_STEPS do not suffice for them beside those before: that
// follows from the numbers of nodes alone, in whatever order they stand.
uint abuffer_sort_several(AbufferRef s, uint first, uint stride, uint waiting) {
    uint left_over = 0u;
    uint reserved = 0u;
    uint place = 0u;
    bool sorting = false;
    AbufferSort sort;
    for (uint i = 0u; i < ABUFFER_SORT_STEPS + ABUFFER_SORT_LISTS * (ABUFFER_SORT_LIMIT + 2u); i++) {
        if (!sorting) {
            if (waiting == 0u) {
                break;
            }
            place = uint(findLSB(waiting));
            waiting &= waiting - 1u;
            sort = abuffer_sort_begin(s, first + place * stride);
            sorting = true;
        }
        uint result = abuffer_sort_step(s, sort);
        if (sort.count > ABUFFER_SORT_LIMIT) {
            result = SORT_COUNTED;
        }
        if (result == SORT_COUNTED) {
            uint cost = abuffer_sort_cost(sort.count);
            bool taken = sort.count <= ABUFFER_SORT_LIMIT && reserved + cost <= ABUFFER_SORT_STEPS;
            reserved += taken ? cost : 0u;
            left_over |= taken ? 0u : 1u << place;
            sorting = taken;
        } else if (result == SORT_DONE) {
            sorting = false;
        }
    }
    return left_over;
}

#endif

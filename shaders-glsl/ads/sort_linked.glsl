// Sorts a linked list in place by merging the ascending runs it consists of, two at a time, until one is left.
// Reads, writes: through what the including file defines before; links are numbers of nodes, 0 ends a list:
//   LINKED_DOUBLY                                                   whether nodes link to the one before
//   uint linked_next(StructureRef s, uint link)
//   void linked_set_next(StructureRef s, uint link, uint next)
//   void linked_set_prev(StructureRef s, uint link, uint prev)      with LINKED_DOUBLY
//   bool linked_comes_first(StructureRef s, uint left, uint right)  a total order
//   uint linked_head(StructureRef s, uint list)
//   void linked_set_ends(StructureRef s, uint list, uint head, uint tail)
// Source: MMRT section 3.3, reorder pass, and Hu et al. section 3.1, sort pass; Knuth 1998, section 5.2.4, natural
// merges. The papers' private array, whose length cuts longer lists short, is not needed: only links change.
// Everything is one loop of bounded length: drivers may end all loops of an invocation after 65,535 iterations,
// and invocations that run in lockstep pay for the longest of each loop.
#ifndef ADS_SORT_LINKED_GLSL
#define ADS_SORT_LINKED_GLSL

#include "ads/constants.glsl"

// Result of a step of the sorting of a list: the list is sorted, the pass goes on, or a pass over the list
// has ended and another is needed.
#define SORT_DONE 0u
#define SORT_MORE 1u
#define SORT_PASSED 2u

// Pass over a list that merges neighbouring runs.
struct LinkedMerge {
    uint left;            // the rest of two runs that are being merged
    uint right;
    bool left_ended;
    bool right_ended;
    uint head;            // of what has been merged
    uint tail;
    uint runs;            // pairs begun
    bool finding;         // the end of the left run is still being searched
    uint at;              // its last node so far
};

void linked_merge_pair(uint begin, inout LinkedMerge merge) {
    merge.left = begin;
    merge.at = begin;
    merge.finding = true;
    merge.left_ended = false;
    merge.right_ended = false;
    merge.runs++;
}

void linked_merge_begin(uint head, inout LinkedMerge merge) {
    merge.head = 0u;
    merge.tail = 0u;
    merge.runs = 0u;
    linked_merge_pair(head, merge);
}

// Moves the first node of one of the two runs behind the merged nodes.
void linked_merge_take(StructureRef s, inout LinkedMerge merge) {
    bool take_left = merge.right_ended || (!merge.left_ended && linked_comes_first(s, merge.left, merge.right));
    uint taken = take_left ? merge.left : merge.right;
    uint next = linked_next(s, taken);
    if (take_left) {
        merge.left_ended = taken == merge.at;
        merge.left = next;
    } else {
        merge.right_ended = next == 0u || !linked_comes_first(s, taken, next);
        merge.right = next;
    }
    if (merge.tail == 0u) {
        merge.head = taken;
    } else {
        linked_set_next(s, merge.tail, taken);
    }
    if (LINKED_DOUBLY) {
        linked_set_prev(s, taken, merge.tail);
    }
    merge.tail = taken;
}

// Counts the nodes of a list; gives `limit` + 1 for a longer one.
uint linked_sort_count(StructureRef s, uint list, uint limit) {
    uint count = 0u;
    uint link = linked_head(s, list);
    while (link != 0u && count <= limit) {
        link = linked_next(s, link);
        count++;
    }
    return count;
}

void linked_sort_begin(StructureRef s, uint list, inout LinkedMerge merge) {
    linked_merge_begin(linked_head(s, list), merge);
}

// Returns a number of steps that is enough for a list: each pass finds the ends of runs and moves nodes, and
// halves the runs.
uint linked_sort_cost(uint count) {
    return count < 2u ? 0u : (uint(findMSB(count - 1u)) + 1u) * (2u * count + 2u);
}

// Makes one step of the sorting of a list of two nodes and more. Between passes the list is whole.
uint linked_sort_step(StructureRef s, uint list, inout LinkedMerge merge) {
    if (merge.finding) {
        uint next = linked_next(s, merge.at);
        if (next != 0u && linked_comes_first(s, merge.at, next)) {
            merge.at = next;
            return SORT_MORE;
        }
        merge.finding = false;
        merge.right = next;
        merge.right_ended = next == 0u;
        // With a single run the list is sorted, and its backward links are renewed on the way.
        return merge.right_ended && merge.runs == 1u && !LINKED_DOUBLY ? SORT_DONE : SORT_MORE;
    }
    linked_merge_take(s, merge);
    if (!merge.left_ended || !merge.right_ended) {
        return SORT_MORE;
    }
    // `right` is the begin of the next run; 0 at the end of the list.
    if (merge.right != 0u) {
        linked_merge_pair(merge.right, merge);
        return SORT_MORE;
    }
    linked_set_next(s, merge.tail, 0u);
    linked_set_ends(s, list, merge.head, merge.tail);
    if (merge.runs == 1u) {
        return SORT_DONE;
    }
    linked_merge_begin(merge.head, merge);
    return SORT_PASSED;
}

// Sorts for at most `steps` steps, including those that count the nodes, in whole passes. Lists of more than
// `limit` nodes stay unchanged. Returns true once the list is sorted.
bool linked_sort(StructureRef s, uint list, uint limit, uint steps) {
    uint count = linked_sort_count(s, list, limit);
    if (count > limit || count < 2u) {
        return count < 2u;
    }
    LinkedMerge merge;
    linked_sort_begin(s, list, merge);
    for (uint i = count; i < steps; i++) {
        uint result = linked_sort_step(s, list, merge);
        if (result == SORT_DONE) {
            return true;
        }
        // A pass finds the end of every other run and moves every node.
        if (result == SORT_PASSED && i + 1u + 2u * count + 2u > steps) {
            return false;
        }
    }
    return false;
}

// Sorts the lists first, first + stride, ... that come before `end`, NODE_SORT_LISTS at most. Returns bits of
// the lists that stay unchanged: lists longer than NODE_SORT_LIMIT, and lists for which NODE_SORT_STEPS is
// not enough in addition to the lists before. The bits follow from the numbers of nodes alone, in any order.
uint linked_sort_several(StructureRef s, uint first, uint stride, uint end) {
    uint waiting = 0u;
    uint left_over = 0u;
    uint reserved = 0u;
    for (uint k = 0u; k < NODE_SORT_LISTS; k++) {
        uint list = first + k * stride;
        uint count = list < end ? linked_sort_count(s, list, NODE_SORT_LIMIT) : 0u;
        if (count >= 2u) {
            uint cost = linked_sort_cost(count);
            bool taken = count <= NODE_SORT_LIMIT && reserved + cost <= NODE_SORT_STEPS;
            reserved += taken ? cost : 0u;
            waiting |= taken ? 1u << k : 0u;
            left_over |= taken ? 0u : 1u << k;
        }
    }
    // There is one loop for all lists, so that neighbours need not wait for each other's lists.
    bool sorting = false;
    uint list = 0u;
    LinkedMerge merge;
    for (uint i = 0u; i < NODE_SORT_STEPS && (sorting || waiting != 0u); i++) {
        if (!sorting) {
            list = first + uint(findLSB(waiting)) * stride;
            waiting &= waiting - 1u;
            linked_sort_begin(s, list, merge);
        }
        sorting = linked_sort_step(s, list, merge) != SORT_DONE;
    }
    return left_over;
}

#endif

// Sorts a linked list in place: merges the ascending runs of which it consists, two at a time, until one run
// is left.
// Reads, writes: through what the including file defines first. A link is the number of a node plus 1; 0 ends
// a list.
//   LINKED_DOUBLY                                                   true if nodes also link backwards
//   uint linked_next(StructureRef s, uint link)
//   void linked_set_next(StructureRef s, uint link, uint next)
//   void linked_set_prev(StructureRef s, uint link, uint prev)      used if LINKED_DOUBLY is true
//   bool linked_comes_first(StructureRef s, uint left, uint right)  a total order
//   uint linked_head(StructureRef s, uint list)
//   void linked_set_ends(StructureRef s, uint list, uint head, uint tail)
// Source: MMRT section 3.3, reorder pass, and Hu et al. section 3.1, sort pass; Knuth 1998, section 5.2.4,
// natural merges. The papers sort in a private array, whose length cuts longer lists short. No array is
// needed here, since only links change.
// There is one loop of bounded length only, because drivers may end all loops of an invocation after 65,535
// iterations, and because invocations that run in lockstep take as many iterations of each loop as the
// slowest of them.
#ifndef ADS_SORT_LINKED_GLSL
#define ADS_SORT_LINKED_GLSL

#include "ads/constants.glsl"

// Result of a step of sorting a list: the list is sorted; the step was one of a pass over the list; or the
// step ended a pass, and another pass is needed.
#define SORT_DONE 0u
#define SORT_MORE 1u
#define SORT_PASSED 2u

// A pass over a list that merges every two neighbouring runs.
struct LinkedMerge {
    uint left;            // first node of the left run that is not merged yet
    uint right;           // first node of the right run that is not merged yet
    bool left_ended;      // true if all nodes of the left run are merged
    bool right_ended;     // true if all nodes of the right run are merged
    uint head;            // first node of what is merged already; 0 at first
    uint tail;            // last node of what is merged already; 0 at first
    uint runs;            // number of pairs of runs begun in this pass
    bool finding;         // true while the end of the left run is being searched
    uint at;              // last node of the left run, as far as it is known
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

// Moves the first node of one of the two runs to the end of what is merged.
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

// Counts the nodes of a list; returns `limit` + 1 for a longer list.
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

// Returns a number of steps that is enough for a list of `count` nodes: each pass finds the ends of runs,
// moves all nodes, and halves the number of runs.
uint linked_sort_cost(uint count) {
    return count < 2u ? 0u : (uint(findMSB(count - 1u)) + 1u) * (2u * count + 2u);
}

// Makes one step of sorting a list of at least two nodes. Between passes the list is whole.
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
        // With a single run the list is sorted. If it is doubly linked, the pass goes on, since it renews the
        // links to nodes before.
        return merge.right_ended && merge.runs == 1u && !LINKED_DOUBLY ? SORT_DONE : SORT_MORE;
    }
    linked_merge_take(s, merge);
    if (!merge.left_ended || !merge.right_ended) {
        return SORT_MORE;
    }
    // `right` is the first node of the next run, or 0 at the end of the list.
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

// Sorts a list for at most `steps` steps, including those that count its nodes, in whole passes. A list of
// more than `limit` nodes stays unchanged. Returns true once the list is sorted.
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
        // A pass finds the end of every other run and moves every node, and must fit into the steps that are
        // left.
        if (result == SORT_PASSED && i + 1u + 2u * count + 2u > steps) {
            return false;
        }
    }
    return false;
}

// Sorts the lists first, first + stride and so on that come before `end`, at most NODE_SORT_LISTS of them.
// Returns bits of the lists that stay unchanged: those with more than NODE_SORT_LIMIT nodes, and those for
// which NODE_SORT_STEPS is not enough in addition to the lists before. The bits depend on the numbers of
// nodes alone, not on their order.
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
    // There is one loop for all lists, so that a thread need not wait for the lists of its neighbours.
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

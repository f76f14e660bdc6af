// Makes one inner node of a tree over sorted Morton codes: children, parent and boxes follow from the codes
// alone, without other nodes.
// Reads: records, scratch (keys, unions). Writes: nodes.
// Source: Karras 2012, figure 4. Equal codes are ordered by their places.
#ifndef BVH_TOPOLOGY_GLSL
#define BVH_TOPOLOGY_GLSL

#include "bvh/unions.glsl"

// Returns the length of the common prefix of the keys at two places; -1 if the second place does not exist.
// The key at a place is the code with the place appended.
int topology_common_prefix(int place, int other) {
    if (other < 0 || other >= int(BVH_HEADER(build.structure).triangle_count)) {
        return -1;
    }
    uint difference = bvh_code(uint(place)) ^ bvh_code(uint(other));
    return difference != 0u ? 31 - findMSB(difference) : 63 - findMSB(uint(place) ^ uint(other));
}

// Returns the reference of a child. If the child is a node, stores in it the link by which it is reached.
uint topology_adopt(int child, bool leaf, uint link) {
    if (leaf) {
        return BVH_LEAF | uint(child);
    }
    bvh_set_parent(build.structure, uint(child), link);
    return uint(child);
}

// Finds the run of records below a node and where its children divide it, and stores the node.
void topology_store(int node) {
    // The run begins or ends at the node's own place. It goes to the side whose neighbour shares the longer
    // prefix.
    int side = topology_common_prefix(node, node + 1) > topology_common_prefix(node, node - 1) ? 1 : -1;
    int outside = topology_common_prefix(node, node - side);
    int reach = 2;
    while (topology_common_prefix(node, node + reach * side) > outside) {
        reach *= 2;
    }
    int length = 0;
    for (int step = reach / 2; step >= 1; step /= 2) {
        if (topology_common_prefix(node, node + (length + step) * side) > outside) {
            length += step;
        }
    }
    int other_end = node + length * side;
    // The split is the last place, seen from this end, that shares a longer prefix with this end than the
    // other end does.
    int in_common = topology_common_prefix(node, other_end);
    int split = 0;
    int step = length;
    do {
        step = (step + 1) / 2;
        if (topology_common_prefix(node, node + (split + step) * side) > in_common) {
            split += step;
        }
    } while (step > 1);
    int last_of_first = node + split * side + min(side, 0);
    uint link = 2u * uint(node);
    uint child_0 = topology_adopt(last_of_first, min(node, other_end) == last_of_first, link);
    uint child_1 = topology_adopt(last_of_first + 1, max(node, other_end) == last_of_first + 1, link + 1u);
    bvh_set_children(build.structure, uint(node), child_0, child_1);
    if (node == 0) {
        bvh_set_parent(build.structure, 0u, BVH_NONE);
    }
    bvh_set_other_end(build.structure, uint(node), uint(other_end));
    union_boxes(uint(node), uint(node), uint(other_end), uint(last_of_first));
}

#endif

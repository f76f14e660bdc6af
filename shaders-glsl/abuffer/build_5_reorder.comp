// What: sorts each list by depth, ties by payload, and renews the backward links.
// Reads: lists, nodes, data. Writes: lists, nodes, header.unsorted.
// Source: MMRT section 3.3, reorder pass. A merge sort of the list in place replaces the paper's
// private array, whose length cut longer lists short.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/accessors.glsl"

layout(local_size_x = ABUFFER_GROUP_SIZE) in;

layout(push_constant, scalar) uniform AbufferBuildConstants {
    AbufferRef abuffer_built;
};

bool comes_first(uint left, uint right) {
    float left_z = abuffer_node(abuffer_built, left).z;
    float right_z = abuffer_node(abuffer_built, right).z;
    return left_z < right_z
        || (left_z == right_z && abuffer_data(abuffer_built, left, 0u) <= abuffer_data(abuffer_built, right, 0u));
}

void main() {
    uint list = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * ABUFFER_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (list >= abuffer_cell_count(abuffer_built) * ABUFFER_BUCKETS) {
        return;
    }
    uint cell = list / ABUFFER_BUCKETS;
    uint bucket = list % ABUFFER_BUCKETS;
    uint head = abuffer_head(abuffer_built, cell, bucket);
    uint length = 0u;
    for (uint link = head; link != 0u && length <= ABUFFER_SORT_LIMIT; length++) {
        link = abuffer_node(abuffer_built, link).next;
    }
    if (length < 2u) {
        return;
    }
    if (length > ABUFFER_SORT_LIMIT) {
        atomicAdd(ABUFFER_HEADER(abuffer_built).unsorted, 1u);
        return;
    }
    // Bottom-up: runs of doubling length are merged until one is left.
    for (uint run = 1u; run < length; run *= 2u) {
        uint left = head;
        head = 0u;
        uint tail = 0u;
        while (left != 0u) {
            uint right = left;
            uint left_count = 0u;
            while (left_count < run && right != 0u) {
                right = abuffer_node(abuffer_built, right).next;
                left_count++;
            }
            uint right_count = run;
            while (left_count > 0u || (right_count > 0u && right != 0u)) {
                bool take_left = left_count > 0u && (right_count == 0u || right == 0u || comes_first(left, right));
                uint taken = take_left ? left : right;
                uint following = abuffer_node(abuffer_built, taken).next;
                if (take_left) {
                    left = following;
                    left_count--;
                } else {
                    right = following;
                    right_count--;
                }
                if (tail == 0u) {
                    head = taken;
                } else {
                    abuffer_set_next(abuffer_built, tail, taken);
                }
                abuffer_set_prev(abuffer_built, taken, tail);
                tail = taken;
            }
            left = right;
        }
        abuffer_set_next(abuffer_built, tail, 0u);
        abuffer_set_list(abuffer_built, cell, bucket, head, tail);
    }
}

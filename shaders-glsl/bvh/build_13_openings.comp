// Finds which nodes below each node of two would be opened if it became a node of four: the one with the
// largest box among its children, then the one with the largest box among the three that it has then.
// Reads: header, nodes. Writes: scratch (openings).
// One invocation per node of two.
// Source: Wald, Benthin and Boulos 2008 (nodes of more children by opening the largest).
#version 460
#include "contract/extensions.glsl"
#include "bvh/area.glsl"
#include "bvh/fours.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

// Chooses a node in place of the choice so far (0: none) if its box is larger. The first node that is offered
// is always chosen, even if areas are not numbers; so a node of four has fewer than four children only if all
// are leaves.
void choose(uint reference, float of_box, uint bit, inout uint chosen, inout float largest) {
    if ((reference & BVH_LEAF) == 0u && (chosen == 0u || of_box > largest)) {
        chosen = bit;
        largest = of_box;
    }
}

void main() {
    uint node = build_invocation();
    if (node + 1u >= BVH_HEADER(build.structure).triangle_count) {
        return;
    }
    float per_metre = scene_lengths_per_metre();
    BvhNode top = bvh_node(build.structure, node);
    if (!is_node(top)) {
        return;
    }
    float area_0 = area(top.lower_0, top.upper_0, per_metre);
    float area_1 = area(top.lower_1, top.upper_1, per_metre);
    uint openings = 0u;
    float largest = 0.0;
    choose(top.child_0, area_0, 1u, openings, largest);
    choose(top.child_1, area_1, 2u, openings, largest);
    if (openings != 0u) {
        bool is_second = openings == 2u;
        BvhNode below = bvh_node(build.structure, is_second ? top.child_1 : top.child_0);
        uint bit = is_second ? 16u : 4u;
        uint next = 0u;
        choose(is_second ? top.child_0 : top.child_1, is_second ? area_0 : area_1, 3u - openings, next, largest);
        choose(below.child_0, area(below.lower_0, below.upper_0, per_metre), bit, next, largest);
        choose(below.child_1, area(below.lower_1, below.upper_1, per_metre), 2u * bit, next, largest);
        openings |= next;
    }
    bvh_set_scratch(build.structure, openings_word(node), openings);
}

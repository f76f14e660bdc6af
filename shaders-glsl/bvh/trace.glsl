// What: finds the nearest or any hit by an ordered descent.
// Reads: header, nodes, records; the scene where alpha is tested. Writes: header.corrupted.
// Source: Laine 2010 and Hapala et al. 2011 (descent that can resume without its stack); Woop et al. 2013
// (the triangle test).
// A plain loop descends one subtree with the references of waiting children on a stack; that of a fresh ray is the whole
// tree. Another one goes upwards from a finished subtree to the next one. A node's children are entered in an order that
// depends on ray and boxes alone, so the link of a subtree is the whole position of a traversal: the stack may be
// forgotten where it is full or a ray pauses.
// cursor[0]: BVH_AT_*, cursor[1]: link of the subtree to enter or just left.
#ifndef BVH_TRACE_GLSL
#define BVH_TRACE_GLSL

#include "contract/trace_functions.glsl"
#include "ads/evaluate.glsl"
#include "bvh/accessors.glsl"
#include "bvh/box.glsl"

// A fresh ray.
#define BVH_AT_START 0u
// The subtree is to be entered; its box has been hit.
#define BVH_AT_ENTRY 1u
// The subtree is done.
#define BVH_AT_EXIT 2u

#define BVH_INFINITY uintBitsToFloat(0x7F800000u)

// The next subtree that waits on the stack and may hold a nearer hit; false where none does.
#define BVH_POP(found) \
    found = false; \
    while (!found && stack_size > 0u) { \
        stack_size -= 1u; \
        child = stack_children[stack_size]; \
        found = stack_entries[stack_size] <= best.t; \
    }

uint bvh_trace(BvhRef s, Ray ray, inout TraceState state, bool any_hit) {
    uint root = BVH_HEADER(s).root;
    if (root == BVH_NONE) {
        return TRACE_MISS;
    }
    BvhRay slabs = BvhRay(vec3(0.0), vec3(0.0), vec3(0.0), 0.0);
    if ((root & BVH_LEAF) == 0u) {
        BvhNode node = bvh_node(s, root);
        slabs = bvh_ray(ray.origin, ray.direction, ray.t_min, min(node.lower_0, node.lower_1), max(node.upper_0, node.upper_1));
    }
    Hit best = state.best;
    // Link of the subtree that is entered or was left.
    uint link = BVH_NONE;
    uint child = root;
    bool entering = true;
    if (state.cursor[0] != BVH_AT_START) {
        entering = state.cursor[0] == BVH_AT_ENTRY;
        link = state.cursor[1];
        child = link == BVH_NONE ? root : bvh_child(s, link);
    }
    uint stack_children[BVH_STACK];
    float stack_entries[BVH_STACK];
    uint stack_size = 0u;
    uint nodes = 0u;
    uint tests = 0u;
    bool paused = false;
    bool ended = false;
    while (!ended) {
        while (entering) {
            while (entering && (child & BVH_LEAF) == 0u && nodes + tests < work_budget) {
                BvhNode node = bvh_node(s, child);
                nodes += 1u;
                float entry_0;
                float entry_1;
                bool intersects_0 = bvh_ray_intersects(slabs, node.lower_0, node.upper_0, best.t, entry_0);
                bool intersects_1 = bvh_ray_intersects(slabs, node.lower_1, node.upper_1, best.t, entry_1);
                trace_log(STEP_NODE, child, node.child_0, 0u, min(entry_0, entry_1), best.t);
                bool first = intersects_0 && !(intersects_1 && entry_1 < entry_0);
                if (intersects_0 && intersects_1) {
                    if (stack_size == BVH_STACK) {
                        // What waits is found again upwards from the child that is entered.
                        link = 2u * child + (first ? 0u : 1u);
                        stack_size = 0u;
                    } else {
                        stack_children[stack_size] = first ? node.child_1 : node.child_0;
                        stack_entries[stack_size] = max(entry_0, entry_1);
                        stack_size += 1u;
                    }
                }
                child = first ? node.child_0 : node.child_1;
                if (!intersects_0 && !intersects_1) {
                    BVH_POP(entering)
                }
            }
            if (entering && (child & BVH_LEAF) == 0u) {
                // The budget is spent: a node knows its own link.
                link = bvh_parent(s, child);
                paused = true;
                break;
            }
            if (entering) {
                uint first = child & ((1u << BVH_LEAF_SHIFT) - 1u);
                uint count = ((child & ~BVH_LEAF) >> BVH_LEAF_SHIFT) + 1u;
                for (uint record = first; record < first + count; record++) {
                    BvhRecord triangle = bvh_record(s, record);
                    test_corners(ray, triangle.primitive, triangle.a, triangle.b, triangle.c, -BVH_INFINITY, BVH_INFINITY, best);
                }
                tests += count;
                if (any_hit && best.primitive != PRIMITIVE_NONE) {
                    link = BVH_NONE;
                    break;
                }
                BVH_POP(entering)
            }
        }
        ended = paused || link == BVH_NONE;
        // Upwards: the sibling comes next if it is the one that is entered second.
        while (!ended && !entering) {
            if (nodes + tests >= work_budget) {
                paused = true;
                ended = true;
                break;
            }
            uint parent = link >> 1u;
            BvhNode node = bvh_node(s, parent);
            nodes += 1u;
            float entry_0;
            float entry_1;
            bool intersects_0 = bvh_ray_intersects(slabs, node.lower_0, node.upper_0, best.t, entry_0);
            bool intersects_1 = bvh_ray_intersects(slabs, node.lower_1, node.upper_1, best.t, entry_1);
            trace_log(STEP_NODE, parent, node.child_0, 0u, min(entry_0, entry_1), best.t);
            bool left_1 = (link & 1u) == 1u;
            bool left_first = left_1 == (entry_1 < entry_0);
            if (left_first && (left_1 ? intersects_0 : intersects_1)) {
                child = left_1 ? node.child_0 : node.child_1;
                link ^= 1u;
                entering = true;
            } else {
                link = node.parent;
                ended = link == BVH_NONE;
            }
        }
    }
    state.best = best;
    state.entries += nodes;
    state.tests += tests;
    if (paused) {
        state.cursor[0] = entering ? BVH_AT_ENTRY : BVH_AT_EXIT;
        state.cursor[1] = link;
        return TRACE_PAUSED;
    }
    return best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
}

#undef BVH_POP

uint bvh_status(BvhRef s) {
    return BVH_HEADER(s).status;
}

Hit bvh_hit(BvhRef s, Hit best) {
    return best;
}

TRACE_FUNCTIONS(BvhRef, bvh)

#endif

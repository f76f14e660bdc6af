// What: finds the nearest or any hit by an ordered descent.
// Reads: header, nodes, records; the scene where alpha is tested. Writes: header.corrupted.
// Source: Laine 2010 and Hapala et al. 2011 (descent that can resume without its stack); Woop et al. 2013
// (the triangle test).
// A node's children are entered in an order that depends on ray and boxes alone. So the link of the
// subtree entered or left last is the whole position of a traversal: the stack only saves the path
// upwards, and may forget its oldest entries, or all of them where a ray pauses.
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

uint bvh_trace(BvhRef s, Ray ray, inout TraceState state, bool any_hit) {
    uint child = BVH_HEADER(s).root;
    if (child == BVH_NONE) {
        return TRACE_MISS;
    }
    BvhRay slabs = bvh_ray(ray.origin, ray.direction, ray.t_min);
    Hit best = state.best;
    uint link = BVH_NONE;
    bool entering = true;
    // Whether there may be subtrees to enter that are not on the stack.
    bool forgotten = false;
    if (state.cursor[0] != BVH_AT_START) {
        entering = state.cursor[0] == BVH_AT_ENTRY;
        link = state.cursor[1];
        child = link == BVH_NONE ? child : bvh_child(s, link);
        forgotten = true;
    }
    uint stack_links[BVH_STACK];
    float stack_entries[BVH_STACK];
    uint stack_end = 0u;
    uint stack_size = 0u;
    uint nodes = 0u;
    uint tests = 0u;
    bool paused = false;
    // Every iteration enters a node or a leaf, leaves one, or takes one from the stack.
    while (true) {
        if (nodes + tests >= work_budget) {
            paused = true;
            break;
        }
        if (entering && (child & BVH_LEAF) == 0u) {
            BvhNode node = bvh_node(s, child);
            nodes += 1u;
            float entry_0;
            float entry_1;
            bool intersects_0 = bvh_ray_intersects(slabs, node.lower_0, node.upper_0, best.t, entry_0);
            bool intersects_1 = bvh_ray_intersects(slabs, node.lower_1, node.upper_1, best.t, entry_1);
            trace_log(STEP_NODE, child, node.child_0, 0u, min(entry_0, entry_1), best.t);
            uint chosen = intersects_0 && !(intersects_1 && entry_1 < entry_0) ? 0u : 1u;
            if (intersects_0 && intersects_1) {
                stack_links[stack_end] = 2u * child + 1u - chosen;
                stack_entries[stack_end] = max(entry_0, entry_1);
                stack_end = (stack_end + 1u) % BVH_STACK;
                forgotten = forgotten || stack_size == BVH_STACK;
                stack_size = min(stack_size + 1u, BVH_STACK);
            }
            entering = intersects_0 || intersects_1;
            if (entering) {
                link = 2u * child + chosen;
                child = chosen == 0u ? node.child_0 : node.child_1;
            }
            continue;
        }
        if (entering) {
            uint first = child & ((1u << BVH_LEAF_SHIFT) - 1u);
            uint count = ((child & ~BVH_LEAF) >> BVH_LEAF_SHIFT) + 1u;
            for (uint record = first; record < first + count; record++) {
                BvhRecord triangle = bvh_record(s, record);
                test_corners(ray, triangle.primitive, triangle.a, triangle.b, triangle.c, -BVH_INFINITY, BVH_INFINITY, best);
            }
            tests += count;
            entering = false;
            if (any_hit && best.primitive != PRIMITIVE_NONE) {
                break;
            }
            continue;
        }
        if (stack_size > 0u) {
            stack_size -= 1u;
            stack_end = (stack_end + BVH_STACK - 1u) % BVH_STACK;
            link = stack_links[stack_end];
            if (stack_entries[stack_end] <= best.t) {
                child = bvh_child(s, link);
                entering = true;
            }
            continue;
        }
        if (!forgotten || link == BVH_NONE) {
            break;
        }
        // Upwards: the sibling comes next if it is the one that is entered second.
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

uint bvh_status(BvhRef s) {
    return BVH_HEADER(s).status;
}

Hit bvh_hit(BvhRef s, Hit best) {
    return best;
}

TRACE_FUNCTIONS(BvhRef, bvh)

#endif

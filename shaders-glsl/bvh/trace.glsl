// Finds a ray's nearest hit, or any hit, by a descent of the tree that enters nearer children first.
// Reads: header, nodes, records; the scene where alpha is tested. Writes: header.corrupted.
// Source: Laine 2010 and Hapala et al. 2011 (descent that can resume without its stack); Woop et al. 2013
// (the triangle test).
// A loop visits nodes. References of children that are to be entered later wait on a stack. The order in
// which the children of a node are entered depends on the ray and their boxes alone, not on the best hit. So
// the link to a subtree tells how far a traversal has come, and the stack may be discarded at any time: once
// the subtree is done, the ray visits the subtree's parent again and enters the children that come after the
// subtree. The stack is discarded when it is full and when the ray pauses. A ray for which neither happens
// visits no node twice.
// The cursor of a paused ray: cursor[0] is BVH_AT_*, cursor[1] is the link to the subtree that is to be
// entered or was just left.
#ifndef BVH_TRACE_GLSL
#define BVH_TRACE_GLSL

#include "contract/trace_functions.glsl"
#include "ads/evaluate.glsl"
#include "bvh/box.glsl"
#include "bvh/loads.glsl"

// Value of cursor[0]: the ray has not begun.
#define BVH_AT_START 0u
// Value of cursor[0]: the subtree of cursor[1] is to be entered. The ray is known to hit its box.
#define BVH_AT_ENTRY 1u
// Value of cursor[0]: the subtree of cursor[1] is done.
#define BVH_AT_EXIT 2u

#define BVH_INFINITY uintBitsToFloat(0x7F800000u)

// Exchanges two components of `keys` and of `children` if the second key is the smaller one.
#define BVH_ORDER(i, j) { \
        bool swaps = keys.j < keys.i; \
        uvec2 first = swaps ? uvec2(keys.j, children.j) : uvec2(keys.i, children.i); \
        uvec2 second = swaps ? uvec2(keys.i, children.i) : uvec2(keys.j, children.j); \
        keys.i = first.x; \
        children.i = first.y; \
        keys.j = second.x; \
        children.j = second.y; \
    }

// Pushes a child on the stack, unless the ray does not enter it.
#define BVH_PUSH(i) \
    if (keys.i != BVH_NO_KEY) { \
        stack_children[stack_size] = children.i; \
        stack_entries[stack_size] = bvh_entry(keys.i); \
        stack_size += 1u; \
    }

// Goes to the subtree that was pushed last and that the ray enters before its best hit. If no such subtree is
// on the stack, goes to the parent of the subtree `within`, which contains everything visited since the stack
// was last discarded. If that subtree is the whole tree, the ray is done.
#define BVH_NEXT \
    bool waits = false; \
    while (!waits && stack_size > 0u) { \
        stack_size -= 1u; \
        waits = stack_entries[stack_size] <= best.t; \
    } \
    done = !waits && within == BVH_NONE; \
    child = waits ? stack_children[stack_size] : within / BVH_CHILDREN; \
    left = waits ? BVH_CHILDREN : within % BVH_CHILDREN;

uint bvh_trace(BvhRef s, Ray ray, inout TraceState state, bool any_hit) {
    uint root = BVH_HEADER(s).root;
    // The capacities are read before the loop, because drivers read a word of a buffer again in each
    // iteration.
    uint node_capacity = BVH_HEADER(s).node_capacity;
    uint record_capacity = BVH_HEADER(s).record_capacity;
    if (root == BVH_NONE) {
        return TRACE_MISS;
    }
    // Without nodes only a leaf at the root can be entered, from the beginning.
    if (node_capacity == 0u && ((root & BVH_LEAF) == 0u || state.cursor[0] != BVH_AT_START)) {
        bvh_count_corrupted(s, 1u);
        return TRACE_MISS;
    }
    BvhRay slabs = bvh_ray(ray.origin, ray.direction, ray.t_min, BVH_HEADER(s).lower, BVH_HEADER(s).upper);
    Hit best = state.best;
    // `child` is the subtree to enter. But if `left` is the number of a child, `child` is a node to visit
    // again, for those of its children that come after child `left` in the ray's order.
    uint child = root;
    uint left = BVH_CHILDREN;
    // Link to the subtree that contains `child` and everything on the stack; BVH_NONE for the whole tree.
    uint within = BVH_NONE;
    if (state.cursor[0] != BVH_AT_START) {
        within = state.cursor[1];
        if (state.cursor[0] == BVH_AT_EXIT) {
            child = within / BVH_CHILDREN;
            left = within % BVH_CHILDREN;
        } else if (within != BVH_NONE) {
            child = bvh_child(s, within);
        }
    }
    uint stack_children[BVH_STACK];
    float stack_entries[BVH_STACK];
    uint stack_size = 0u;
    uint nodes = 0u;
    uint tests = 0u;
    uint corrupted = 0u;
    bool paused = false;
    bool done = false;
    while (!done) {
        while (!done && (child & BVH_LEAF) == 0u && nodes + tests < work_budget) {
            // Where a reference is damaged, an existing node is read and none of its children is entered:
            // values to return in its place would have to be merged with those of the node in each iteration.
            bool exists = child < node_capacity;
            corrupted += uint(!exists);
            BvhChildren node = bvh_children(s, min(child, node_capacity - 1u), slabs.descends);
            nodes += 1u;
            bvec4 entered;
            uvec4 keys = bvh_child_keys(slabs, node, best.t, entered);
            entered = mix(bvec4(false), entered, bvec4(exists));
            if (left < BVH_CHILDREN) {
                within = bvh_parent(s, child);
                entered = mix(bvec4(false), entered, greaterThan(keys, uvec4(keys[left])));
            }
            keys = mix(uvec4(BVH_NO_KEY), keys, entered);
            uvec4 children = node.references;
            BVH_ORDER(x, y)
            if (BVH_CHILDREN == BVH_FOUR) {
                BVH_ORDER(z, w)
                BVH_ORDER(x, z)
                BVH_ORDER(y, w)
                BVH_ORDER(y, z)
            }
            trace_log(STEP_NODE, child, node.references.x, 0u, keys.x == BVH_NO_KEY ? BVH_INFINITY : bvh_entry(keys.x), best.t);
            if (keys.x == BVH_NO_KEY) {
                BVH_NEXT
            } else {
                if (stack_size + BVH_CHILDREN > BVH_STACK + 1u) {
                    // There may be no room for the other children. They are found again once the entered
                    // child is done.
                    within = BVH_CHILDREN * child + (keys.x & 3u);
                    stack_size = 0u;
                } else {
                    if (BVH_CHILDREN == BVH_FOUR) {
                        BVH_PUSH(w)
                        BVH_PUSH(z)
                    }
                    BVH_PUSH(y)
                }
                child = children.x;
                left = BVH_CHILDREN;
            }
        }
        if (done) {
            break;
        }
        if ((child & BVH_LEAF) == 0u) {
            // The budget is spent, and `child` is a node that was not visited yet.
            paused = true;
            break;
        }
        uint first = bvh_leaf_first(child);
        uint count = bvh_leaf_count(child);
        if (first >= record_capacity || count > record_capacity - first) {
            corrupted += 1u;
            count = 0u;
        }
        for (uint record = first; record < first + count; record++) {
            BvhRecord triangle = bvh_existing_record(s, record);
            test_corners(ray, triangle.primitive, triangle.a, triangle.b, triangle.c, -BVH_INFINITY, BVH_INFINITY, best);
        }
        tests += count;
        if (any_hit && best.primitive != PRIMITIVE_NONE) {
            break;
        }
        BVH_NEXT
    }
    bvh_count_corrupted(s, corrupted);
    state.best = best;
    state.entries += nodes;
    state.tests += tests;
    if (paused) {
        // `child` is a node, and nodes store the link by which they are reached.
        state.cursor[0] = left < BVH_CHILDREN ? BVH_AT_EXIT : BVH_AT_ENTRY;
        state.cursor[1] = left < BVH_CHILDREN ? BVH_CHILDREN * child + left : bvh_parent(s, child);
        return TRACE_PAUSED;
    }
    return best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
}

#undef BVH_ORDER
#undef BVH_PUSH
#undef BVH_NEXT

uint bvh_status(BvhRef s) {
    return BVH_HEADER(s).status;
}

Hit bvh_hit(BvhRef s, Hit best) {
    return best;
}

TRACE_FUNCTIONS(BvhRef, bvh)

#endif

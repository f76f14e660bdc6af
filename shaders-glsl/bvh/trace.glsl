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

float bvh_least(vec4 values) {
    return min(min(values.x, values.y), min(values.z, values.w));
}

float bvh_most(vec4 values) {
    return max(max(values.x, values.y), max(values.z, values.w));
}

// Exchanges two children of `keys` and `children` where the second comes first.
#define BVH_ORDER(i, j) { \
        bool swaps = keys.j < keys.i; \
        uvec2 first = swaps ? uvec2(keys.j, children.j) : uvec2(keys.i, children.i); \
        uvec2 second = swaps ? uvec2(keys.i, children.i) : uvec2(keys.j, children.j); \
        keys.i = first.x; \
        children.i = first.y; \
        keys.j = second.x; \
        children.j = second.y; \
    }

// Leaves a child to be entered later.
#define BVH_PUSH(i) \
    if (keys.i != BVH_NO_KEY) { \
        stack_children[stack_size] = children.i; \
        stack_entries[stack_size] = bvh_entry(keys.i); \
        stack_size += 1u; \
    }

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
    vec3 lower = vec3(0.0);
    vec3 upper = vec3(0.0);
    if ((root & BVH_LEAF) == 0u) {
        BvhWideNode node = bvh_node(s, root);
        lower = vec3(bvh_least(node.lower_x), bvh_least(node.lower_y), bvh_least(node.lower_z));
        upper = vec3(bvh_most(node.upper_x), bvh_most(node.upper_y), bvh_most(node.upper_z));
    }
    BvhRay slabs = bvh_ray(ray.origin, ray.direction, ray.t_min, lower, upper);
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
                BvhWideNode node = bvh_node(s, child);
                nodes += 1u;
                uvec4 keys = bvh_keys(slabs, node, best.t, BVH_WIDE);
                uvec4 children = node.children;
                BVH_ORDER(x, y)
                if (BVH_WIDTH == BVH_WIDE) {
                    BVH_ORDER(z, w)
                    BVH_ORDER(x, z)
                    BVH_ORDER(y, w)
                    BVH_ORDER(y, z)
                }
                trace_log(STEP_NODE, child, node.children.x, 0u, bvh_entry(keys.x), best.t);
                if (keys.x == BVH_NO_KEY) {
                    BVH_POP(entering)
                } else {
                    if (stack_size + BVH_WIDTH > BVH_STACK + 1u) {
                        // Those that wait are found again upwards from the child that is entered.
                        link = BVH_WIDTH * child + (keys.x & 3u);
                        stack_size = 0u;
                    } else {
                        if (BVH_WIDTH == BVH_WIDE) {
                            BVH_PUSH(w)
                            BVH_PUSH(z)
                        }
                        BVH_PUSH(y)
                    }
                    child = children.x;
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
        // Upwards: of the siblings that are entered later, the first one comes next.
        while (!ended && !entering) {
            if (nodes + tests >= work_budget) {
                paused = true;
                ended = true;
                break;
            }
            uint parent = link / BVH_WIDTH;
            uint left = link % BVH_WIDTH;
            BvhWideNode node = bvh_node(s, parent);
            nodes += 1u;
            uvec4 keys = bvh_keys(slabs, node, best.t, left);
            trace_log(STEP_NODE, parent, node.children.x, 0u, bvh_entry(keys[left]), best.t);
            uvec4 later = mix(uvec4(BVH_NO_KEY), keys, greaterThan(keys, uvec4(keys[left])));
            uint next = min(min(later.x, later.y), min(later.z, later.w));
            if (next != BVH_NO_KEY) {
                link = BVH_WIDTH * parent + (next & 3u);
                child = node.children[next & 3u];
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

#undef BVH_ORDER
#undef BVH_PUSH
#undef BVH_POP

uint bvh_status(BvhRef s) {
    return BVH_HEADER(s).status;
}

Hit bvh_hit(BvhRef s, Hit best) {
    return best;
}

TRACE_FUNCTIONS(BvhRef, bvh)

#endif

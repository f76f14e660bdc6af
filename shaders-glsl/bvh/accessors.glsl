// Access to the tree's pools: header, nodes, records and scratch, each read and written by functions of its
// own.
// Reads, writes: header, nodes, records, scratch. Every access compares the index with the capacity of the
// pool. ads/pools.glsl says how pools are reached.
#ifndef BVH_ACCESSORS_GLSL
#define BVH_ACCESSORS_GLSL

#include "ads/pools.glsl"
#include "bvh/steps.glsl"
#include "bvh/types.glsl"

STRUCTURE_HEADER(Bvh, bvh)
#define BVH_HEADER(s) STRUCTURE_HEADER_OF(Bvh, bvh, s)

POOL_RECORDS(bvh, nodes, 1, BvhNode)
POOL_RECORDS(bvh, nodes_of_four, 1, BvhNodeOfFour)
POOL_RECORDS(bvh, records, 2, BvhRecord)
POOL_WORDS(bvh, scratch, 3)
#define BVH_NODES(s) POOL_VIEW_OF(bvh, nodes, BVH_HEADER(s).nodes_address)
#define BVH_NODES_OF_FOUR(s) POOL_VIEW_OF(bvh, nodes_of_four, BVH_HEADER(s).nodes_address)
#define BVH_RECORDS(s) POOL_VIEW_OF(bvh, records, BVH_HEADER(s).records_address)
#define BVH_POOL(s, pool) POOL_WORDS_OF(bvh, pool, BVH_HEADER(s))

// Adds to the count of invalid indices. Readers count in a variable and call this once, because an atomic in
// a loop costs time.
void bvh_count_corrupted(BvhRef s, uint corrupted) {
    if (corrupted != 0u) {
        atomicAdd(BVH_HEADER(s).corrupted, corrupted);
    }
}

// Returns the link by which a node is reached.
uint bvh_parent(BvhRef s, uint node) {
    if (node >= BVH_HEADER(s).node_capacity) {
        return BVH_NONE;
    }
    return BVH_CHILDREN == BVH_FOUR ? BVH_NODES_OF_FOUR(s)[node].parent : BVH_NODES(s)[node].parent;
}

// Returns the child that a link refers to.
uint bvh_child(BvhRef s, uint link) {
    uint node = link / BVH_CHILDREN;
    if (node >= BVH_HEADER(s).node_capacity) {
        return BVH_NONE;
    }
    uint slot = link % BVH_CHILDREN;
    if (BVH_CHILDREN == BVH_FOUR) {
        return BVH_NODES_OF_FOUR(s)[node].children[slot];
    }
    return slot == 0u ? BVH_NODES(s)[node].child_0 : BVH_NODES(s)[node].child_1;
}

// Returns the first record of a leaf.
uint bvh_leaf_first(uint reference) {
    return reference & ((1u << BVH_LEAF_SHIFT) - 1u);
}

// Returns the number of records of a leaf.
uint bvh_leaf_count(uint reference) {
    return ((reference & ~BVH_LEAF) >> BVH_LEAF_SHIFT) + 1u;
}

// Returns the triangle of a record; PRIMITIVE_NONE past the end.
uint bvh_primitive(BvhRef s, uint record) {
    return record < BVH_HEADER(s).record_capacity ? BVH_RECORDS(s)[record].primitive : PRIMITIVE_NONE;
}

void bvh_set_record(BvhRef s, uint record, BvhRecord value) {
    if (record < BVH_HEADER(s).record_capacity) {
        BVH_RECORDS(s)[record] = value;
    }
}

// Returns the place of a node of two in the pool of nodes, counted in nodes. If the tree has nodes of four,
// which are made from nodes of two, the nodes of two lie behind them.
uint bvh_pair_place(BvhRef s, uint node) {
    return BVH_CHILDREN == BVH_FOUR ? BVH_HEADER(s).node_capacity + node : node;
}

// Reads a node of two. Its members are read one by one and not as vectors, so that an invocation sees what it
// wrote itself. An index past the end gives a node whose children are leaves with the first record.
BvhNode bvh_node(BvhRef s, uint node) {
    if (node >= BVH_HEADER(s).pair_capacity) {
        return BvhNode(vec3(0.0), BVH_LEAF, vec3(0.0), BVH_LEAF, vec3(0.0), BVH_NONE, vec3(0.0), 0u);
    }
    return BVH_NODES(s)[bvh_pair_place(s, node)];
}

// Sets all members of a node of two.
void bvh_set_node(BvhRef s, uint node, BvhNode value) {
    if (node < BVH_HEADER(s).pair_capacity) {
        BVH_NODES(s)[bvh_pair_place(s, node)] = value;
    }
}

// Sets the references of both children of a node of two. The boxes stay unchanged.
void bvh_set_children(BvhRef s, uint node, uint child_0, uint child_1) {
    if (node < BVH_HEADER(s).pair_capacity) {
        uint place = bvh_pair_place(s, node);
        BVH_NODES(s)[place].child_0 = child_0;
        BVH_NODES(s)[place].child_1 = child_1;
    }
}

// Sets the other end of the run of records below a node of two.
void bvh_set_other_end(BvhRef s, uint node, uint other_end) {
    if (node < BVH_HEADER(s).pair_capacity) {
        BVH_NODES(s)[bvh_pair_place(s, node)].other_end = other_end;
    }
}

// Sets the link by which a node of two is reached.
void bvh_set_parent(BvhRef s, uint node, uint link) {
    if (node < BVH_HEADER(s).pair_capacity) {
        BVH_NODES(s)[bvh_pair_place(s, node)].parent = link;
    }
}

// Sets the box of one child of a node of two, given the link to that child.
void bvh_set_box(BvhRef s, uint link, vec3 lower, vec3 upper) {
    uint node = link >> 1u;
    if (node >= BVH_HEADER(s).pair_capacity) {
        return;
    }
    uint place = bvh_pair_place(s, node);
    if ((link & 1u) == 0u) {
        BVH_NODES(s)[place].lower_0 = lower;
        BVH_NODES(s)[place].upper_0 = upper;
    } else {
        BVH_NODES(s)[place].lower_1 = lower;
        BVH_NODES(s)[place].upper_1 = upper;
    }
}

// Sets the children of a node of four and their boxes: `lower[axis][i]` and `upper[axis][i]` are sides of
// child i. The link by which the node is reached stays unchanged.
void bvh_set_children_of_four(BvhRef s, uint node, uvec4 children, mat3x4 lower, mat3x4 upper) {
    if (node >= BVH_HEADER(s).node_capacity) {
        return;
    }
    vec3 origin;
    uint steps = 0u;
    uvec2 sides[3];
    [[unroll]] for (uint axis = 0u; axis < 3u; axis++) {
        vec4 low = bvh_steps_lower(lower[axis]);
        vec4 high = bvh_steps_upper(upper[axis]);
        origin[axis] = min(min(low.x, low.y), min(low.z, low.w));
        uint exponent = bvh_steps_exponent(origin[axis], max(max(high.x, high.y), max(high.z, high.w)));
        float size = uintBitsToFloat(exponent << 23u);
        steps |= exponent << 8u * axis;
        sides[axis] = uvec2(0u);
        [[unroll]] for (uint place = 0u; place < BVH_FOUR; place++) {
            sides[axis].x |= bvh_steps_below(low[place], origin[axis], size) << 8u * place;
            sides[axis].y |= bvh_steps_above(high[place], origin[axis], size) << 8u * place;
        }
    }
    BVH_NODES_OF_FOUR(s)[node].origin = origin;
    BVH_NODES_OF_FOUR(s)[node].steps = steps;
    BVH_NODES_OF_FOUR(s)[node].x = sides[0];
    BVH_NODES_OF_FOUR(s)[node].y = sides[1];
    BVH_NODES_OF_FOUR(s)[node].z = sides[2];
    BVH_NODES_OF_FOUR(s)[node].children = children;
}

// Sets the link by which a node of four is reached.
void bvh_set_parent_of_four(BvhRef s, uint node, uint link) {
    if (node < BVH_HEADER(s).node_capacity) {
        BVH_NODES_OF_FOUR(s)[node].parent = link;
    }
}

uint bvh_scratch(BvhRef s, uint word) {
    return word < BVH_HEADER(s).scratch_capacity ? BVH_POOL(s, scratch)[word] : 0u;
}

void bvh_set_scratch(BvhRef s, uint word, uint value) {
    if (word < BVH_HEADER(s).scratch_capacity) {
        BVH_POOL(s, scratch)[word] = value;
    }
}

// True if this word and the two after it are within the pool.
bool bvh_scratch_has_point(BvhRef s, uint word) {
    uint capacity = BVH_HEADER(s).scratch_capacity;
    return capacity >= 3u && word <= capacity - 3u;
}

// Reads three consecutive words as a point; returns the origin if they are not within the pool.
vec3 bvh_scratch_point(BvhRef s, uint word) {
    if (!bvh_scratch_has_point(s, word)) {
        return vec3(0.0);
    }
    return uintBitsToFloat(uvec3(BVH_POOL(s, scratch)[word], BVH_POOL(s, scratch)[word + 1u], BVH_POOL(s, scratch)[word + 2u]));
}

void bvh_set_scratch_point(BvhRef s, uint word, vec3 point) {
    if (bvh_scratch_has_point(s, word)) {
        BVH_POOL(s, scratch)[word] = floatBitsToUint(point.x);
        BVH_POOL(s, scratch)[word + 1u] = floatBitsToUint(point.y);
        BVH_POOL(s, scratch)[word + 2u] = floatBitsToUint(point.z);
    }
}

// Adds to a word with an atomic operation, since other invocations may add to it, and returns the value
// before.
uint bvh_add_scratch(BvhRef s, uint word, uint value) {
    if (word >= BVH_HEADER(s).scratch_capacity) {
        return 0u;
    }
    return atomicAdd(BVH_POOL(s, scratch)[word], value);
}

// Raises a word to a value, as above. A word past the end is taken to be the largest.
uint bvh_max_scratch(BvhRef s, uint word, uint value) {
    if (word >= BVH_HEADER(s).scratch_capacity) {
        return 0xFFFFFFFFu;
    }
    return atomicMax(BVH_POOL(s, scratch)[word], value);
}

#endif

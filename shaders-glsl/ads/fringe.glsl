// What: the fringe of a cell: triangles that reach into it and have no fragment there, in a linked list of their own. Links are
// node number + 1; 0 ends a list. Included once for each structure that has one: its reference type tells the functions apart.
// Reads, writes: through what the including file defines before, all of it undefined again at the end:
//   FringeRef                the type that names the structure
//   FRINGE_HEAD(s, cell)     the first link of a cell
//   FRINGE_NODES(s)          words of the nodes: triangle and next link
//   FRINGE_HEADER(s)         has fringe_demand, fringe_capacity and corrupted
// Source: not in the papers; MMRT names edge-on triangles as its open limit.

// Puts a triangle into a cell's fringe, or counts that there was no room for it.
void fringe_add(FringeRef s, uint cell, uint primitive) {
    uint node = atomicAdd(FRINGE_HEADER(s).fringe_demand, 1u);
    if (node < FRINGE_HEADER(s).fringe_capacity) {
        FRINGE_NODES(s)[2u * node] = primitive;
        FRINGE_NODES(s)[2u * node + 1u] = atomicExchange(FRINGE_HEAD(s, cell), node + 1u);
    }
}

// Primitive and next link of the node behind a link. A link past the end is counted and answers the end.
uvec2 fringe_node(FringeRef s, uint link) {
    if (link - 1u >= min(FRINGE_HEADER(s).fringe_capacity, FRINGE_HEADER(s).fringe_demand)) {
        atomicAdd(FRINGE_HEADER(s).corrupted, 1u);
        return uvec2(PRIMITIVE_NONE, 0u);
    }
    return uvec2(FRINGE_NODES(s)[2u * link - 2u], FRINGE_NODES(s)[2u * link - 1u]);
}

#undef FringeRef
#undef FRINGE_HEAD
#undef FRINGE_NODES
#undef FRINGE_HEADER

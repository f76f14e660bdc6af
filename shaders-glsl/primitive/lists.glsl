// Stores and reads the lists of triangles.
// Reads, writes: lists, entries, header.demand, header.corrupted.
// Source: DIRT section 3.2, fill primitives.
// A linked list consists of nodes of two words: a triangle, and the link of the next node. A link is the
// number of a node plus 1; 0 ends a list. A contiguous list consists of triangles only. Once all triangles
// are stored, the word of a list is the place of its end, and the word before it the place of its begin.
#ifndef PRIMITIVE_LISTS_GLSL
#define PRIMITIVE_LISTS_GLSL

#include "ads/append.glsl"
#include "ads/geometry.glsl"
#include "primitive/accessors.glsl"

// The position in a list that is being read.
struct PrimitiveCursor {
    uint at;              // linked: link of the next node; contiguous: place of the next entry
    uint end;             // contiguous: place behind the last entry
};

// Returns the number of entries that are stored.
uint primitive_stored(PrimitiveRef s) {
    return min(PRIMITIVE_HEADER(s).capacity, PRIMITIVE_HEADER(s).demand);
}

// Begins to read a list. A contiguous list that leaves the pool or whose end comes before its begin is
// counted as corrupted, and read as empty.
PrimitiveCursor primitive_list_begin(PrimitiveRef s, uint list) {
    uint word = PRIMITIVE_POOL(s, lists)[list];
    if (PRIMITIVE_STORAGE == PRIMITIVE_STORAGE_LINKED) {
        return PrimitiveCursor(word, 0u);
    }
    uint begin = list == 0u ? 0u : PRIMITIVE_POOL(s, lists)[list - 1u];
    if (begin > word || word > primitive_stored(s)) {
        atomicAdd(PRIMITIVE_HEADER(s).corrupted, 1u);
        return PrimitiveCursor(0u, 0u);
    }
    return PrimitiveCursor(begin, word);
}

// Goes on to read a list at position `at`.
PrimitiveCursor primitive_list_resume(PrimitiveRef s, uint list, uint at) {
    return PrimitiveCursor(at, PRIMITIVE_STORAGE == PRIMITIVE_STORAGE_LINKED ? 0u : PRIMITIVE_POOL(s, lists)[list]);
}

bool primitive_list_ended(PrimitiveCursor cursor) {
    return PRIMITIVE_STORAGE == PRIMITIVE_STORAGE_LINKED ? cursor.at == 0u : cursor.at >= cursor.end;
}

// Returns the next triangle of a list that has not ended. If the entry is past the end of the pool, counts
// it, ends the list, and returns PRIMITIVE_NONE. If the entry is no triangle, counts it and returns
// PRIMITIVE_NONE.
uint primitive_list_next(PrimitiveRef s, inout PrimitiveCursor cursor) {
    uint entry = PRIMITIVE_STORAGE == PRIMITIVE_STORAGE_LINKED ? cursor.at - 1u : cursor.at;
    if (entry >= primitive_stored(s)) {
        atomicAdd(PRIMITIVE_HEADER(s).corrupted, 1u);
        cursor = PrimitiveCursor(0u, 0u);
        return PRIMITIVE_NONE;
    }
    uint primitive;
    if (PRIMITIVE_STORAGE == PRIMITIVE_STORAGE_LINKED) {
        cursor.at = PRIMITIVE_POOL(s, entries)[2u * entry + 1u];
        primitive = PRIMITIVE_POOL(s, entries)[2u * entry];
    } else {
        cursor.at += 1u;
        primitive = PRIMITIVE_POOL(s, entries)[entry];
    }
    if (primitive >= geometry_triangle_count()) {
        atomicAdd(PRIMITIVE_HEADER(s).corrupted, 1u);
        return PRIMITIVE_NONE;
    }
    return primitive;
}

// Adds one to the length of a contiguous list.
void primitive_list_count_one(PrimitiveRef s, uint list) {
    atomicAdd(PRIMITIVE_POOL(s, lists)[list], 1u);
}

// Stores a triangle in a list. Beyond the capacity the triangle is only counted.
void primitive_list_store(PrimitiveRef s, uint list, uint primitive) {
    if (PRIMITIVE_STORAGE == PRIMITIVE_STORAGE_CONTIGUOUS) {
        LIST_APPEND(PRIMITIVE_POOL(s, lists)[list], PRIMITIVE_HEADER(s).capacity, PRIMITIVE_POOL(s, entries), 0u, primitive)
        return;
    }
    uint node = atomicAdd(PRIMITIVE_HEADER(s).demand, 1u);
    if (node < PRIMITIVE_HEADER(s).capacity) {
        PRIMITIVE_POOL(s, entries)[2u * node] = primitive;
        PRIMITIVE_POOL(s, entries)[2u * node + 1u] = atomicExchange(PRIMITIVE_POOL(s, lists)[list], node + 1u);
    }
}

#endif

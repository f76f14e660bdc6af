// The alpha test of geometry without alpha: every candidate counts.
// Reads, writes: nothing.
// An embedder with masked materials provides a file with the same function instead.
#ifndef CONTRACT_ALPHA_OPAQUE_GLSL
#define CONTRACT_ALPHA_OPAQUE_GLSL

// True if the point of a triangle counts as a hit. primitive: its number in the geometry that is bound; geometry_id
// gives its id, which differs in parts. barycentrics: weights of vertices 1 and 2.
bool alpha_accepts(uint primitive, vec2 barycentrics) {
    return true;
}

#endif

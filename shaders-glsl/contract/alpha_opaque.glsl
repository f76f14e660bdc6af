// The alpha test of geometry without alpha: every candidate counts as a hit.
// Reads, writes: nothing.
// An embedder with masked materials provides a file with the same function in place of this one.
#ifndef CONTRACT_ALPHA_OPAQUE_GLSL
#define CONTRACT_ALPHA_OPAQUE_GLSL

// Returns true if the point of a triangle counts as a hit. `primitive` is the triangle's number in the
// geometry that is bound; in a part of a geometry the id differs from it (geometry_id). `barycentrics` are
// the weights of vertices 1 and 2.
bool alpha_accepts(uint primitive, vec2 barycentrics) {
    return true;
}

#endif

// Forwards the contract's plain names to the structure for which a shader is compiled. `structure/...` is its
// folder, given as STRUCTURE in the permutation list.
// Reads, writes: see the structure.
#ifndef CONTRACT_SELECT_GLSL
#define CONTRACT_SELECT_GLSL

#include "structure/names.glsl"
#include "structure/trace.glsl"

uint trace_ray(StructureRef s, Ray ray, inout TraceState state, bool any_hit, out Hit hit) {
    return STRUCTURE_NAME(trace_ray)(s, ray, state, any_hit, hit);
}

#ifdef SURFACES_ENABLED
#include "structure/surface.glsl"

Surface surface_at(StructureRef s, Ray ray, Hit hit) {
    return STRUCTURE_NAME(surface_at)(s, ray, hit);
}
#endif

#endif

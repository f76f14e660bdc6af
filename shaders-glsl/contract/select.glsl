// Gives the contract's functions of one structure their plain names: `trace_ray` and `surface_at`.
// Reads, writes: see the structure.
// Each module is compiled for one structure. The include path `structure/` stands for the folder of that
// structure, which the module's line in permutations.txt gives as STRUCTURE.
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

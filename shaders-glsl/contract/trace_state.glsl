// The state of a traversal when a ray starts, the validity of rays, and the order of hits.
// Reads, writes: nothing.
#ifndef CONTRACT_TRACE_STATE_GLSL
#define CONTRACT_TRACE_STATE_GLSL

#include "contract/types.glsl"

// Constant ids 0 to 9 belong to the contract.
layout(constant_id = 0) const uint COUNTERS = COUNTERS_OFF;

// Form of the loops that search lists; the host chooses it by the driver. If true, an inner loop advances to
// the next entry that may be hit, and the entry is tested after that loop, so that invocations that run in
// lockstep test at the same time. If false, entries are tested within the one loop over all entries. Hits,
// counters and steps are equal. Searches for which one form is faster on every driver ignore this constant.
layout(constant_id = 1) const bool NESTED_SEARCH = true;

// Units of work after which a ray pauses: cells visited, entries read, primitives tested. This is a variable
// and not a specialisation constant, so that one kernel serves every budget.
uint work_budget = TRACE_WORK_BUDGET;

// Returns the state of a ray that has not been traced yet.
TraceState trace_state_begin(Ray ray) {
    TraceState state;
    state.best = Hit(ray.t_max, PRIMITIVE_NONE, 0.0, 0.0);
    for (int i = 0; i < 8; i++) {
        state.cursor[i] = 0u;
    }
    state.cells = 0u;
    state.entries = 0u;
    state.tests = 0u;
    state.visit = 0u;
    return state;
}

// True if a ray is valid: its origin and direction are finite, its direction is not zero, t_min and t_max are
// not NaN, and t_max is not negative. The function tests bits, because comparisons with NaN are not
// dependable.
bool ray_is_valid(Ray ray) {
    const uint infinite = 0x7F800000u;
    bool finite = all(lessThan(floatBitsToUint(ray.origin) & 0x7FFFFFFFu, uvec3(infinite)))
        && all(lessThan(floatBitsToUint(ray.direction) & 0x7FFFFFFFu, uvec3(infinite)));
    bool ends = (floatBitsToUint(ray.t_min) & 0x7FFFFFFFu) <= infinite && (floatBitsToUint(ray.t_max) & 0x7FFFFFFFu) <= infinite
        && ray.t_max >= 0.0;
    return finite && ends && any(notEqual(ray.direction, vec3(0.0)));
}

// True if a candidate at (t, primitive) replaces the best hit: if it is nearer, or as near with a lower id.
// The answer therefore does not depend on the order of the candidates.
bool hit_is_better(Hit best, float t, uint primitive) {
    return t < best.t || (t == best.t && best.primitive != PRIMITIVE_NONE && primitive < best.primitive);
}

#endif

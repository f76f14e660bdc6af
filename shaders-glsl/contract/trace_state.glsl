// A traversal's state at the start of a ray, and the rule by which hits are ranked.
// Reads, writes: nothing.
#ifndef CONTRACT_TRACE_STATE_GLSL
#define CONTRACT_TRACE_STATE_GLSL

#include "contract/types.glsl"

// Constant ids 0 to 9 belong to the contract.
layout(constant_id = 0) const uint COUNTERS = COUNTERS_OFF;

// True if a search of a list is to find the next entry that may be hit in a loop of its own, so that rays that
// run together test theirs together; false if it is to test within the loop over all entries. The host chooses
// by the driver; hits, counters and steps are equal. Searches that gain by one form on every driver ignore it.
layout(constant_id = 1) const bool NESTED_SEARCH = true;

// Units of work after which a ray pauses. A variable, not a constant: one kernel serves every budget.
uint work_budget = TRACE_WORK_BUDGET;

// The state of a ray that has not been traced yet.
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

// True if a ray is valid: origin and direction finite, the direction not zero,
// no end of the range NaN, t_max not negative. Decided on bits: comparisons with NaN are not dependable.
bool ray_is_valid(Ray ray) {
    const uint infinite = 0x7F800000u;
    bool finite = all(lessThan(floatBitsToUint(ray.origin) & 0x7FFFFFFFu, uvec3(infinite)))
        && all(lessThan(floatBitsToUint(ray.direction) & 0x7FFFFFFFu, uvec3(infinite)));
    bool ends = (floatBitsToUint(ray.t_min) & 0x7FFFFFFFu) <= infinite && (floatBitsToUint(ray.t_max) & 0x7FFFFFFFu) <= infinite
        && ray.t_max >= 0.0;
    return finite && ends && any(notEqual(ray.direction, vec3(0.0)));
}

// True if a candidate at (t, primitive) replaces the best hit: nearer, or as near with a lower id,
// so that the answer does not depend on the order of the candidates.
bool hit_is_better(Hit best, float t, uint primitive) {
    return t < best.t || (t == best.t && best.primitive != PRIMITIVE_NONE && primitive < best.primitive);
}

#endif

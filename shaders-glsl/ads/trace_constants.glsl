// The push constants of the kernels that trace a queue or find the surfaces at its hits.
// Reads: push constants. Writes: nothing.
// The including file first includes contract/select.glsl, which defines StructureRef.
#ifndef ADS_TRACE_CONSTANTS_GLSL
#define ADS_TRACE_CONSTANTS_GLSL

#include "ads/constants.glsl"

// The structure, the slots, and what is asked of a trace. 28 bytes.
layout(push_constant, scalar) uniform TraceConstants {
    StructureRef structure;   // the device address of the header, low word first; zero with descriptors
    uint domain;              // number of first slots, or DOMAIN_SELECTED
    uint work_budget;         // units of work that a ray may spend in one dispatch
    // PART_*: whether the triangles are all of a geometry or a part; where surfaces are found, plus
    // PART_AFTER for each part traced later
    uint part;
    uint any_hit;             // 1: any hit will do; 0: the nearest hit is to be found
    uint is_last;             // 1: no round follows, so rays that pause get no answer
} trace;

#endif

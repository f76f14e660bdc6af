// The push constants of the kernels that trace a queue or find surfaces at its hits.
// Reads: push constants. Writes: nothing.
// Included after contract/select.glsl, which says what StructureRef is.
#ifndef ADS_TRACE_CONSTANTS_GLSL
#define ADS_TRACE_CONSTANTS_GLSL

#include "ads/constants.glsl"

// Structure that a queue is traced through, and the slots traced. 24 bytes.
layout(push_constant, scalar) uniform TraceConstants {
    StructureRef structure;   // the device address of the header, low word first; zero with descriptors
    uint domain;              // the number of first slots, or DOMAIN_SELECTED
    uint work_budget;         // units of work that a ray may spend per dispatch
    uint part;                // PART_*: what the triangles are of the geometry that rays are traced through
    uint any_hit;             // 1: any hit will do; 0: the nearest is looked for
} trace;

#endif

// Numbers that shaders and Rust share. build.rs turns every `#define NAME number` of this file into
// a Rust constant of the same name; nothing else may stand here.
#ifndef CONTRACT_CONSTANTS_GLSL
#define CONTRACT_CONSTANTS_GLSL

// "No primitive": a miss, or a structure that does not know the id.
#define PRIMITIVE_NONE 0xFFFFFFFFu

// What a trace function returns.
#define TRACE_MISS 0u
#define TRACE_HIT 1u
// The work budget of this dispatch is used up; the state holds enough to go on.
#define TRACE_PAUSED 2u
// The structure was not complete when it was traced; no answer was given.
#define TRACE_NOT_READY 3u

// In Hit.primitive: a fragment without a known triangle; a and b are the structure's.
#define PRIMITIVE_UNKNOWN 0xFFFFFFFEu

// Ray flags.
// The ray only asks whether anything is hit.
#define RAY_OCCLUDED 1u

// Draw flags.
#define DRAW_ALPHA_MASKED 1u
#define DRAW_STATIC 2u

// Which fields of a Surface carry what the structure knows; the others hold documented defaults.
#define SURFACE_POSITION 1u
#define SURFACE_NORMAL 2u
#define SURFACE_MATERIAL 4u
#define SURFACE_PRIMITIVE 8u
#define SURFACE_EMISSION 16u

// How much of their work rays record; each value includes those below it.
#define COUNTERS_OFF 0u
// Sums over all rays, in the queue's header.
#define COUNTERS_SUMS 1u
// A RayWork per slot.
#define COUNTERS_PER_RAY 2u
// Every step of the logged slot.
#define COUNTERS_STEPS 3u

// Threads in a workgroup of a queue kernel.
#define QUEUE_GROUP_SIZE 64u

// Work units (cells stepped, list entries read, primitive tests) a ray may spend in one dispatch.
// Software drivers end all loops of a group of eight invocations after 65,535 iterations in all.
#define TRACE_WORK_BUDGET 4096u

// Bits of a structure's status word.
#define STATUS_COMPLETE 1u
#define STATUS_OVERFLOW 2u
#define STATUS_UNSORTED 4u

#endif

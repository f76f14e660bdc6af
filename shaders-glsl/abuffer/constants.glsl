// Numbers that the A-buffer's shaders and crate share. Only `#define NAME number` may stand here.
#ifndef ABUFFER_CONSTANTS_GLSL
#define ABUFFER_CONSTANTS_GLSL

// How a ray steps through cells.
#define ABUFFER_MARCH_SAMPLES 0u
#define ABUFFER_MARCH_EXACT 1u

// When a fragment counts as hit.
#define ABUFFER_ACCEPT_INTERVAL 0u
#define ABUFFER_ACCEPT_THICKNESS 1u
#define ABUFFER_ACCEPT_PLANE 2u

// What a fragment carries.
#define ABUFFER_PAYLOAD_INDEX 0u
#define ABUFFER_PAYLOAD_ATTRIBUTES 1u

// Who decides that a cell is covered.
#define ABUFFER_COVERAGE_HARDWARE 0u
#define ABUFFER_COVERAGE_EXACT 1u

// Longest list that the reorder pass sorts; longer ones stay unordered and are counted.
#define ABUFFER_SORT_LIMIT 1024u

// How far a fragment's plane reaches beyond its triangle, in widths of a cell at that depth. More closes
// gaps between triangles smaller than a cell, less keeps planes seen edge-on out of the way.
#define ABUFFER_PLANE_REACH 2.0

// Threads in a workgroup of the build's compute passes.
#define ABUFFER_GROUP_SIZE 64u

#endif

// Chooses whether the steps of a traversal are written to a queue or discarded; no other file chooses it.
// Reads, writes: see the file chosen.
// Queue kernels define TRACE_LOG; in all other shaders the functions below do nothing.
// Every structure calls trace_log for each step of a traversal, with a kind STEP_*. The meaning of a, b, c,
// t_low and t_high depends on the kind (contract/constants.glsl). It calls trace_log_view for each view that
// a ray enters, and trace_log_visit for each cell that is visited and each entry that is read from a cell.
// Cells, nodes, entries and tests are logged exactly where TraceState counts them.
#ifndef CONTRACT_TRACE_LOG_GLSL
#define CONTRACT_TRACE_LOG_GLSL

#ifdef TRACE_LOG
#include "ads/queue_log.glsl"
#else
void trace_log(uint kind, uint a, uint b, uint c, float t_low, float t_high) {}
void trace_log_view(uint view, float t_low, float t_high) {}
void trace_log_visit(uint kind, uint a, uint b, uint c, float t_low, float t_high) {}
#endif

#endif

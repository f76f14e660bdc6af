// The one place that says where the steps of a traversal are written. TRACE_LOG is set by the queue
// kernels; elsewhere steps are discarded.
// Reads, writes: see the file chosen.
// Every structure calls trace_log(kind, a, b, c, t_low, t_high) for what it does, with the STEP_* kinds of
// contract/constants.glsl; for a view that it enters trace_log_view, for a cell and what it reads of the cell trace_log_visit.
// A cell, a node, an entry and a test are logged exactly where the state counts them.
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

// Declares the header of an A-buffer, and the macro that reaches it.
// Reads, writes: header. Stages that define STRUCTURE_READ_ONLY only read it.
#ifndef ABUFFER_HEADER_GLSL
#define ABUFFER_HEADER_GLSL

#include "ads/pools.glsl"
#include "abuffer/types.glsl"

STRUCTURE_HEADER(Abuffer, abuffer)
#define ABUFFER_HEADER(s) STRUCTURE_HEADER_OF(Abuffer, abuffer, s)

#endif

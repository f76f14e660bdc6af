// The header of an A-buffer.
// Reads, writes: header; stages with STRUCTURE_READ_ONLY only read it.
#ifndef ABUFFER_HEADER_GLSL
#define ABUFFER_HEADER_GLSL

#include "ads/pools.glsl"
#include "abuffer/types.glsl"

STRUCTURE_HEADER(Abuffer, abuffer)
#define ABUFFER_HEADER(s) STRUCTURE_HEADER_OF(Abuffer, abuffer, s)

#endif

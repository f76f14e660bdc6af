// Declares the header of a layered depth cube, and the macro that reaches it.
// Reads, writes: header. Stages that define STRUCTURE_READ_ONLY only read it.
#ifndef LDC_HEADER_GLSL
#define LDC_HEADER_GLSL

#include "ads/pools.glsl"
#include "ldc/types.glsl"

STRUCTURE_HEADER(Ldc, ldc)
#define LDC_HEADER(s) STRUCTURE_HEADER_OF(Ldc, ldc, s)

#endif

// What: the header of a layered depth cube, and how it is reached.
// Reads, writes: header. Stages that only read say so (LDC_READ_ONLY), because writing from a vertex shader is a
// device feature of its own.
#ifndef LDC_HEADER_GLSL
#define LDC_HEADER_GLSL

#include "ldc/types.glsl"

#ifndef STRUCTURE_SET
#define STRUCTURE_SET 1
#endif

#ifdef LDC_READ_ONLY
#define LDC_HEADER_ACCESS readonly
#else
#define LDC_HEADER_ACCESS
#endif

// Where a layered depth cube is. Unused with descriptors.
struct LdcRef {
    uvec2 header;
};

#ifdef ADDRESSING_ADDRESS
layout(buffer_reference, scalar, buffer_reference_align = 4) LDC_HEADER_ACCESS buffer LdcHeaderAddress { LdcHeader header; };
#define LDC_HEADER(s) LdcHeaderAddress(s.header).header
#else
layout(set = STRUCTURE_SET, binding = 0, scalar) LDC_HEADER_ACCESS buffer LdcHeaderBuffer { LdcHeader ldc_header; };
#define LDC_HEADER(s) ldc_header
#endif

#endif

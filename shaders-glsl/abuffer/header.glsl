// What: the header of an A-buffer, and how it is reached.
// Reads, writes: header. Stages that only read say so (ABUFFER_READ_ONLY), because writing from a
// vertex shader is a device feature of its own.
#ifndef ABUFFER_HEADER_GLSL
#define ABUFFER_HEADER_GLSL

#include "abuffer/types.glsl"

#ifndef STRUCTURE_SET
#define STRUCTURE_SET 1
#endif

#ifdef ABUFFER_READ_ONLY
#define ABUFFER_HEADER_ACCESS readonly
#else
#define ABUFFER_HEADER_ACCESS
#endif

// Where an A-buffer is. Unused with descriptors.
struct AbufferRef {
    uvec2 header;
};

#ifdef ADDRESSING_ADDRESS
layout(buffer_reference, scalar, buffer_reference_align = 4) ABUFFER_HEADER_ACCESS buffer AbufferHeaderAddress { AbufferHeader header; };
#define ABUFFER_HEADER(s) AbufferHeaderAddress(s.header).header
#else
layout(set = STRUCTURE_SET, binding = 0, scalar) ABUFFER_HEADER_ACCESS buffer AbufferHeaderBuffer { AbufferHeader abuffer_header; };
#define ABUFFER_HEADER(s) abuffer_header
#endif

#endif

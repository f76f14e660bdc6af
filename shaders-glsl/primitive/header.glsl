// What: the header of primitive lists, and how it is reached.
// Reads, writes: header. Stages that only read say so (PRIMITIVE_READ_ONLY), because writing from a
// vertex shader is a device feature of its own.
#ifndef PRIMITIVE_HEADER_GLSL
#define PRIMITIVE_HEADER_GLSL

#include "primitive/types.glsl"

#ifndef STRUCTURE_SET
#define STRUCTURE_SET 1
#endif

#ifdef PRIMITIVE_READ_ONLY
#define PRIMITIVE_HEADER_ACCESS readonly
#else
#define PRIMITIVE_HEADER_ACCESS
#endif

// Where primitive lists are. Unused with descriptors.
struct PrimitiveRef {
    uvec2 header;
};

#ifdef ADDRESSING_ADDRESS
layout(buffer_reference, scalar, buffer_reference_align = 4) PRIMITIVE_HEADER_ACCESS buffer PrimitiveHeaderAddress { PrimitiveHeader header; };
#define PRIMITIVE_HEADER(s) PrimitiveHeaderAddress(s.header).header
#else
layout(set = STRUCTURE_SET, binding = 0, scalar) PRIMITIVE_HEADER_ACCESS buffer PrimitiveHeaderBuffer { PrimitiveHeader primitive_header; };
#define PRIMITIVE_HEADER(s) primitive_header
#endif

#endif

// What: the header of bricks, and how it is reached.
// Reads, writes: header. Stages that only read say so (BRICK_READ_ONLY), because writing from a
// vertex shader is a device feature of its own.
#ifndef BRICKS_HEADER_GLSL
#define BRICKS_HEADER_GLSL

#include "bricks/types.glsl"

#ifndef STRUCTURE_SET
#define STRUCTURE_SET 1
#endif

#ifdef BRICK_READ_ONLY
#define BRICK_HEADER_ACCESS readonly
#else
#define BRICK_HEADER_ACCESS
#endif

// Where bricks are. Unused with descriptors.
struct BrickRef {
    uvec2 header;
};

#ifdef ADDRESSING_ADDRESS
layout(buffer_reference, scalar, buffer_reference_align = 4) BRICK_HEADER_ACCESS buffer BrickHeaderAddress { BrickHeader header; };
#define BRICK_HEADER(s) BrickHeaderAddress(s.header).header
#else
layout(set = STRUCTURE_SET, binding = 0, scalar) BRICK_HEADER_ACCESS buffer BrickHeaderBuffer { BrickHeader brick_header; };
#define BRICK_HEADER(s) brick_header
#endif

#endif

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

mat3 primitive_camera(PrimitiveRef s) {
    return mat3(PRIMITIVE_HEADER(s).camera_x, PRIMITIVE_HEADER(s).camera_y, PRIMITIVE_HEADER(s).camera_z);
}

vec3 primitive_turned(mat3 turn, vec3 v) {
    precise vec3 turned = turn[0] * v.x + turn[1] * v.y + turn[2] * v.z;
    return turned;
}

// A point relative to the centre, or a direction, in the space of the faces; with the camera's view alone in one that is
// turned and scaled so that the pyramid of face 0 is what the camera sees.
vec3 primitive_seen(PrimitiveRef s, vec3 v) {
    if (PRIMITIVE_VIEWS == PRIMITIVE_VIEWS_CUBE) {
        return v;
    }
    return primitive_turned(primitive_camera(s), v);
}

#endif

// The header of primitive lists, and the transformation into the space of the faces.
// Reads, writes: header; shaders that define STRUCTURE_READ_ONLY only read it.
#ifndef PRIMITIVE_HEADER_GLSL
#define PRIMITIVE_HEADER_GLSL

#include "ads/pools.glsl"
#include "primitive/types.glsl"

STRUCTURE_HEADER(Primitive, primitive)
#define PRIMITIVE_HEADER(s) STRUCTURE_HEADER_OF(Primitive, primitive, s)

mat3 primitive_camera(PrimitiveRef s) {
    return mat3(PRIMITIVE_HEADER(s).camera_x, PRIMITIVE_HEADER(s).camera_y, PRIMITIVE_HEADER(s).camera_z);
}

vec3 primitive_turned(mat3 turn, vec3 v) {
    precise vec3 turned = turn[0] * v.x + turn[1] * v.y + turn[2] * v.z;
    return turned;
}

// Transforms a point relative to the centre, or a direction, into the space of the faces. If the only view is
// the camera's, that space is transformed so that the pyramid of face 0 is the view of the camera.
vec3 primitive_seen(PrimitiveRef s, vec3 v) {
    if (PRIMITIVE_VIEWS == PRIMITIVE_VIEWS_CUBE) {
        return v;
    }
    return primitive_turned(primitive_camera(s), v);
}

#endif

// Numbers that the shaders and the crate of the driver's tree share. Only `#define NAME number` may stand
// here.
#ifndef DRIVER_CONSTANTS_GLSL
#define DRIVER_CONSTANTS_GLSL

// Number of words of a box: two corners.
#define DRIVER_BOX_WORDS 6u

#endif

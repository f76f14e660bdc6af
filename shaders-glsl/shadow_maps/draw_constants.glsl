// The push constants of the passes that draw views.
// Reads: push constants. Writes: nothing.
#ifndef SHADOW_MAPS_DRAW_CONSTANTS_GLSL
#define SHADOW_MAPS_DRAW_CONSTANTS_GLSL

// Views of a draw. 4 bytes.
layout(push_constant, scalar) uniform ShadowMapsDrawConstants {
    uint first_view;      // of the instances drawn
} drawn;

#endif

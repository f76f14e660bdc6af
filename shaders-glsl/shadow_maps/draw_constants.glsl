// Declares the push constants of the passes that draw views.
// Reads: push constants. Writes: nothing.
#ifndef SHADOW_MAPS_DRAW_CONSTANTS_GLSL
#define SHADOW_MAPS_DRAW_CONSTANTS_GLSL

// The views onto which a draw goes. 4 bytes.
layout(push_constant, scalar) uniform ShadowMapsDrawConstants {
    uint first_view;      // view of the first instance; the others follow
} drawn;

#endif

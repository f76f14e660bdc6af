// Numbers that shadow maps share with Rust.
// Only `#define NAME number` stands here: Rust constants of the same names are generated from it.
// Source: docs/shadow-maps.md.
#ifndef SHADOW_MAPS_CONSTANTS_GLSL
#define SHADOW_MAPS_CONSTANTS_GLSL

// Number of views of a cube around a light.
#define SHADOW_MAPS_CUBE_VIEWS 6u
// Cosine of the widest half angle of a light's cone that one view covers. Wider cones have a cube of views.
#define SHADOW_MAPS_WIDEST_COSINE 0.5
// Cosine of the narrowest half angle of a view. A narrower cone gets a view that is wider than the cone.
#define SHADOW_MAPS_NARROWEST_COSINE 0.99999
// Ratio of the tangent of a view's half angle to that of its cone. It keeps directions at the rim of the cone
// on the map despite rounding.
#define SHADOW_MAPS_WIDENED 1.001
// Bound of the rounding of positions, of their depths and of the triangle test, divided by the largest length
// involved: 64 units of rounding.
#define SHADOW_MAPS_ROUNDING 3.9e-6
// Texel without a triangle, as bits.
#define SHADOW_MAPS_EMPTY 0xFFFFFFFFu

#endif

// Numbers that shadow maps share with Rust.
// Only `#define NAME number` stands here: Rust constants of the same names are generated from it.
// Source: docs/shadow-maps.md.
#ifndef SHADOW_MAPS_CONSTANTS_GLSL
#define SHADOW_MAPS_CONSTANTS_GLSL

// Number of views of a cube around a light.
#define SHADOW_MAPS_CUBE_VIEWS 6u
// Cosine of the widest half angle of a cone that one view covers; wider cones have a cube.
#define SHADOW_MAPS_WIDEST_COSINE 0.5
// Cosine of the narrowest half angle of a view: a narrower cone has a wider view than it needs.
#define SHADOW_MAPS_NARROWEST_COSINE 0.99999
// Ratio of a view's tangent to that of its cone, so that directions at the rim are on the map despite
// rounding.
#define SHADOW_MAPS_WIDENED 1.001
// Bound of the rounding of positions, of their depths and of the triangle test, relative to the largest
// length involved: 64 u.
#define SHADOW_MAPS_ROUNDING 3.9e-6
// Depth without a triangle, as bits.
#define SHADOW_MAPS_EMPTY 0xFFFFFFFFu

#endif

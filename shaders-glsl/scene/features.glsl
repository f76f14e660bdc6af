// What: the parts of shading a module contains. An entry may set each macro, before it includes anything, to a
// constant or to the name of a specialisation constant; unset means everything.
// Reads: nothing. Writes: nothing. Source: docs/shading.md, "Functions".
#ifndef SCENE_FEATURES_GLSL
#define SCENE_FEATURES_GLSL

// Any texture is referenced.
#ifndef SHADING_TEXTURES
#define SHADING_TEXTURES true
#endif
// Texels lie in several buffers.
#ifndef SHADING_TEXEL_RUNS
#define SHADING_TEXEL_RUNS true
#endif
// Any material transmits.
#ifndef SHADING_TRANSMISSION
#define SHADING_TRANSMISSION true
#endif
// Any material blends.
#ifndef SHADING_BLEND
#define SHADING_BLEND true
#endif

#endif

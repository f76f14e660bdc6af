// What: the parts of shading a module contains. An entry may set each macro, before it includes anything, to a
// constant or to the name of a specialisation constant. Unset, textures are specialisation constants 90 and 94, which
// every pipeline that reads a scene is made with, and the others mean everything.
// Reads: nothing. Writes: nothing. Source: docs/shading.md, "Functions".
#ifndef SCENE_FEATURES_GLSL
#define SCENE_FEATURES_GLSL

// Any texture is referenced.
#ifndef SHADING_TEXTURES
layout(constant_id = 90) const bool SCENE_HAS_TEXTURES = true;
#define SHADING_TEXTURES SCENE_HAS_TEXTURES
#endif
// Texels lie in several buffers.
#ifndef SHADING_TEXEL_RUNS
layout(constant_id = 94) const bool SCENE_HAS_TEXEL_RUNS = true;
#define SHADING_TEXEL_RUNS SCENE_HAS_TEXEL_RUNS
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

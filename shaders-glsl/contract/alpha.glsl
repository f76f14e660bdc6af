// Chooses the alpha test that traces and builds call (`alpha_accepts`); no other file chooses it.
// Reads, writes: see the file chosen.
// Modules that bind the scene's descriptor set define ALPHA_SCENE and get the scene's test. All other modules
// treat every triangle as opaque.
#ifndef CONTRACT_ALPHA_GLSL
#define CONTRACT_ALPHA_GLSL

#ifdef ALPHA_SCENE
#include "scene/alpha.glsl"
#else
#include "contract/alpha_opaque.glsl"
#endif

#endif

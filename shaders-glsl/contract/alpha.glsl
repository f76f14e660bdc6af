// The one place that chooses the alpha test. ALPHA_SCENE is set by permutations that carry
// the scene's set; without it geometry is opaque.
// Reads, writes: see the file chosen.
#ifndef CONTRACT_ALPHA_GLSL
#define CONTRACT_ALPHA_GLSL

#ifdef ALPHA_SCENE
#include "scene/alpha.glsl"
#else
#include "contract/alpha_opaque.glsl"
#endif

#endif

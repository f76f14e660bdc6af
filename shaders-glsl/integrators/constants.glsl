// Numbers that integrators share with Rust.
// Only `#define NAME number` stands here: Rust constants of the same names are generated from it.
// Source: docs/whitted.md, docs/cube-map.md, docs/photons.md.
#ifndef INTEGRATORS_CONSTANTS_GLSL
#define INTEGRATORS_CONSTANTS_GLSL

// WaveConstants.marks of Whitted's integrator, beside WAVE_ROUND_*.
// Mirrored and refracted rays are traced whatever their weight.
#define WHITTED_SELECTS_ALL 4u
// Surfaces that the camera sees send rays on where they mirror, and nowhere else.
#define WHITTED_SELECTS_REFLECTIVE 8u
// Only surfaces that mirror or refract trace shadow rays.
#define WHITTED_SHADOWS_SPECULAR 16u
// Only surfaces that the camera sees trace shadow rays.
#define WHITTED_SHADOWS_FIRST 32u
// No shadow ray is traced.
#define WHITTED_SHADOWS_NONE 64u

// WhittedState.waiting where no ray is left to be traced.
#define WHITTED_ENDED 0xFFFFFFFFu

// FetchConstants.step.
// Counts the hits of each pixel.
#define FETCH_COUNT 0u
// Gives each list its place.
#define FETCH_PLACE 1u
// Stores the slots of each list.
#define FETCH_STORE 2u
// Most hits of a list that one fragment looks at. Software drivers end the loops of an invocation after 65,535 iterations
// in all, and every surface has loops of its own.
#define FETCH_PART 256u
// WhittedNode.branch of the rays of a cube map: their random numbers are those of no camera ray.
#define CUBE_MAP_BRANCH 1u

// WaveConstants.marks of photons that are emitted, beside WAVE_ROUND_*: WaveConstants.number is the radius over the
// diagonal of the bounds of all triangles, and not metres.
#define PHOTON_RADIUS_IS_SHARE 4u
// In the place of a pixel, with the number of the sample, of the random numbers of photons. No pixel has this bit.
#define PHOTON_PIXEL 0x80000000u
// Most photons that one surface looks at. Software drivers end the loops of an invocation after 65,535 iterations in all.
#define PHOTON_GATHER_LIMIT 60000u

#endif

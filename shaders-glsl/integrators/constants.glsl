// Numbers that integrators share with Rust.
// Only `#define NAME number` stands here: Rust constants of the same names are generated from it.
// Source: docs/whitted.md, docs/cube-map.md, docs/photons.md.
#ifndef INTEGRATORS_CONSTANTS_GLSL
#define INTEGRATORS_CONSTANTS_GLSL

// Mark of Whitted's integrator in WaveConstants.marks, beside WAVE_ROUND_*: mirrored and refracted rays are
// traced whatever their weight.
#define WHITTED_SELECTS_ALL 4u
// Mark of Whitted's integrator: of the surfaces that the camera sees, only those that mirror send rays on.
#define WHITTED_SELECTS_REFLECTIVE 8u
// Mark of Whitted's integrator: only surfaces that mirror or refract trace shadow rays.
#define WHITTED_SHADOWS_SPECULAR 16u
// Mark of Whitted's integrator: only surfaces that the camera sees trace shadow rays.
#define WHITTED_SHADOWS_FIRST 32u
// Mark of Whitted's integrator: no shadow ray is traced.
#define WHITTED_SHADOWS_NONE 64u

// Value of WhittedState.waiting if the tree has no ray left to trace.
#define WHITTED_ENDED 0xFFFFFFFFu

// Value of FetchConstants.step: the pass counts the hits of each pixel.
#define FETCH_COUNT 0u
// Value of FetchConstants.step: the pass gives each list its place.
#define FETCH_PLACE 1u
// Value of FetchConstants.step: the pass stores the slots of each list.
#define FETCH_STORE 2u
// Maximum number of hits of a list that one fragment looks at. Software drivers end the loops of an
// invocation after 65,535 iterations in all, and computing a surface takes loops of its own.
#define FETCH_PART 256u
// Value of WhittedNode.branch for the rays of a cube map. It gives them random numbers that no camera ray
// has.
#define CUBE_MAP_BRANCH 1u

// Mark of the pass that emits photons in WaveConstants.marks, beside WAVE_ROUND_*: WaveConstants.number is
// the radius divided by the diagonal of the bounds of all triangles, and not in metres.
#define PHOTON_RADIUS_IS_SHARE 4u
// Bit that replaces the pixel, together with the number of the sample, in the random numbers of photons. No
// pixel has this bit.
#define PHOTON_PIXEL 0x80000000u
// Maximum number of photons that one surface looks at. Software drivers end the loops of an invocation after
// 65,535 iterations in all.
#define PHOTON_GATHER_LIMIT 60000u

#endif

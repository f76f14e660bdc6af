// Uses of random numbers. One sample of one pixel uses a dimension at most once.
// Only `#define NAME number` stands here: Rust constants of the same names are generated from it.
// Source: docs/shading.md, "Random numbers".
// Dimensions come in groups of four. The last two of a group are spread best over a square, so they serve as
// places.
#ifndef SCENE_RANDOM_DIMENSIONS_GLSL
#define SCENE_RANDOM_DIMENSIONS_GLSL

// Place on the lens.
#define RANDOM_LENS_U 0u
#define RANDOM_LENS_V 1u
// Position inside the pixel.
#define RANDOM_CAMERA_X 2u
#define RANDOM_CAMERA_Y 3u

// First dimension of scatterings. Scattering k (0 is that at the first surface) owns the dimensions
// RANDOM_BOUNCE_FIRST + k * RANDOM_BOUNCE_STRIDE + one of the offsets below.
#define RANDOM_BOUNCE_FIRST 4u
#define RANDOM_BOUNCE_STRIDE 12u

// Offsets of the uses at one scattering: kind of light, light, place on the light; then lobe, side and
// direction of the scattering; then the choice to end the path.
#define RANDOM_LIGHT_KIND 0u
#define RANDOM_LIGHT_PICK 1u
#define RANDOM_LIGHT_U 2u
#define RANDOM_LIGHT_V 3u
#define RANDOM_BSDF_LOBE 4u
#define RANDOM_BSDF_SIDE 5u
#define RANDOM_BSDF_U 6u
#define RANDOM_BSDF_V 7u
#define RANDOM_ROULETTE 8u

// First dimension of a path's choices to go straight on through a surface. Choice number n, counted over the
// whole path, uses RANDOM_OPACITY_FIRST + n. The number is above the dimensions of all scatterings, since the
// number of choices has no bound.
#define RANDOM_OPACITY_FIRST 65536u

#endif

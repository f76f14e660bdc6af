// Uses of random numbers. One sample of one pixel draws dimension d at most once.
// Only `#define NAME number` stands here: Rust constants of the same names are generated from it.
// Source: docs/shading.md, "Random numbers".
// Dimensions come in groups of four; the last two of a group are spread best over a square, so places stand there.
#ifndef SCENE_RANDOM_DIMENSIONS_GLSL
#define SCENE_RANDOM_DIMENSIONS_GLSL

// Place on the lens.
#define RANDOM_LENS_U 0u
#define RANDOM_LENS_V 1u
// Position inside the pixel.
#define RANDOM_CAMERA_X 2u
#define RANDOM_CAMERA_Y 3u

// First dimension of scatterings. Scattering k (0 is the first surface) owns the dimensions
// RANDOM_BOUNCE_FIRST + k * RANDOM_BOUNCE_STRIDE + one of the offsets below.
#define RANDOM_BOUNCE_FIRST 4u
#define RANDOM_BOUNCE_STRIDE 12u

#define RANDOM_LIGHT_KIND 0u
#define RANDOM_LIGHT_PICK 1u
#define RANDOM_LIGHT_U 2u
#define RANDOM_LIGHT_V 3u
#define RANDOM_BSDF_LOBE 4u
#define RANDOM_BSDF_SIDE 5u
#define RANDOM_BSDF_U 6u
#define RANDOM_BSDF_V 7u
#define RANDOM_ROULETTE 8u

// First dimension of the choices of a path to go straight on through a surface: choice number n, counted over
// the whole path, draws RANDOM_OPACITY_FIRST + n. It is above every block of scatterings, and the choices
// have no end.
#define RANDOM_OPACITY_FIRST 65536u

#endif

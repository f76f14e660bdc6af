// A cube map of radiance around one point. Each of its six faces has a border of one texel, which the
// neighbouring face has as well, so that a lookup blends four texels of one face.
// Reads: texels and header of INTEGRATOR_SET, frame. Writes: nothing.
// Source: docs/cube-map.md; Greene 1986.
#ifndef INTEGRATORS_CUBE_MAP_GLSL
#define INTEGRATORS_CUBE_MAP_GLSL

#include "ads/float_keys.glsl"
#include "integrators/constants.glsl"
#include "integrators/storage.glsl"
#include "scene/camera.glsl"

// The size of a cube map, and its point. Shared, 44 bytes.
struct CubeMapHeader {
    uint resolution;          // texels along a side of a face, without its border
    vec3 position;            // metres relative to the frame origin
    // 1: `position` is the point; 0: the point is the centre of the bounds below, or the eye if these are
    // empty
    uint is_given;
    // lower corner of all perfectly smooth triangles: integers in the order of the floats
    uint lower_keys[3];
    uint upper_keys[3];       // upper corner of the same triangles, in the same form
};

// Texels lie face after face, row after row. In face f, axis f / 2 is the largest of a direction, and it is
// negative for odd f. The next axis in cyclic order grows along a row, and the axis after it grows from row
// to row.
layout(set = INTEGRATOR_SET, binding = 11, scalar) readonly buffer CubeMapTexelBuffer { FilmPixel cube_map_texels[]; };
#ifdef CUBE_MAP_HEADER_WRITTEN
layout(set = INTEGRATOR_SET, binding = 12, scalar) buffer CubeMapHeaderBuffer { CubeMapHeader cube_map_header; };
#else
layout(set = INTEGRATOR_SET, binding = 12, scalar) readonly buffer CubeMapHeaderBuffer {
    CubeMapHeader cube_map_header;
};
#endif

// Returns the point of the cube map, metres relative to the frame origin.
vec3 cube_map_position() {
    if (cube_map_header.is_given != 0u) return cube_map_header.position;
    if (cube_map_header.lower_keys[0] > cube_map_header.upper_keys[0]) return scene_frame().camera_position;
    vec3 lower, upper;
    [[unroll]] for (int axis = 0; axis < 3; axis++) {
        lower[axis] = float_of(cube_map_header.lower_keys[axis]);
        upper[axis] = float_of(cube_map_header.upper_keys[axis]);
    }
    return 0.5 * (lower + upper);
}

// Returns a ray from the point through a place in a texel; places are distributed uniformly over the texel.
Ray cube_map_ray(uint texel, uint sample_index) {
    uint side = cube_map_header.resolution + 2u;
    uint face = texel / (side * side);
    uint within = texel % (side * side);
    vec2 place = vec2(within % side, within / side);
    place += random_place(texel, sample_index, RANDOM_CAMERA_X + 256u * CUBE_MAP_BRANCH);
    float width = 2.0 / float(cube_map_header.resolution);
    vec2 across = (place - 1.0) * width - 1.0;
    uint axis = face >> 1;
    vec3 direction;
    direction[axis] = (face & 1u) == 0u ? 1.0 : -1.0;
    direction[(axis + 1u) % 3u] = across.x;
    direction[(axis + 2u) % 3u] = across.y;
    Frame frame = scene_frame();
    return Ray(cube_map_position(), 0.0, normalize(direction), uintBitsToFloat(0x7F800000u), PRIMITIVE_NONE,
               frame.camera_ray_flags, 0.0, width * frame.footprint_scale);
}

// Returns the radiance from a direction, W/(sr m^2). A texel has one sample. If that sample was not finite,
// the texel has none and is black.
vec3 cube_map_radiance(vec3 direction) {
    vec3 size = abs(direction);
    uint axis = size.x >= size.y && size.x >= size.z ? 0u : (size.y >= size.z ? 1u : 2u);
    vec2 across = vec2(direction[(axis + 1u) % 3u], direction[(axis + 2u) % 3u]) / size[axis];
    uint resolution = cube_map_header.resolution;
    uint side = resolution + 2u;
    // The place is in texels, whose centres are at whole numbers.
    vec2 place = (across + 1.0) * (0.5 * float(resolution)) + 0.5;
    uvec2 first = min(uvec2(place), uvec2(resolution));
    vec2 weight = place - vec2(first);
    uint face = 2u * axis + (direction[axis] < 0.0 ? 1u : 0u);
    uint texel = (face * side + first.y) * side + first.x;
    vec3 row = mix(cube_map_texels[texel].sum, cube_map_texels[texel + 1u].sum, weight.x);
    texel += side;
    vec3 next_row = mix(cube_map_texels[texel].sum, cube_map_texels[texel + 1u].sum, weight.x);
    return mix(row, next_row, weight.y);
}

#endif

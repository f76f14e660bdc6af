// Makes the camera rays of a pixel.
// Reads: frame. Writes: nothing.
// Source: docs/shading.md, "Functions" and "Lens".
#ifndef SCENE_CAMERA_GLSL
#define SCENE_CAMERA_GLSL

#include "scene/accessors.glsl"
#include "scene/microfacet.glsl"
#include "scene/random.glsl"

// Returns the ray through the centre of the lens. `pixel_position` is in pixels from the top left corner of
// the image; the centre of the first pixel is (0.5, 0.5).
Ray camera_ray(vec2 pixel_position) {
    Frame frame = scene_frame();
    float x = (2.0 * pixel_position.x / float(frame.width) - 1.0) * frame.half_width;
    float y = (1.0 - 2.0 * pixel_position.y / float(frame.height)) * frame.half_height;
    vec3 across = frame.camera_right * x + frame.camera_up * y;
    bool perspective = frame.projection == PROJECTION_PERSPECTIVE;
    vec3 origin = perspective ? frame.camera_position : frame.camera_position + across;
    vec3 direction = perspective ? normalize(frame.camera_forward + across) : frame.camera_forward;
    return Ray(origin, 0.0, direction, uintBitsToFloat(0x7F800000u), PRIMITIVE_NONE, frame.camera_ray_flags,
               frame.cone_width * frame.footprint_scale, frame.cone_spread * frame.footprint_scale);
}

// Returns a position for a sample, distributed uniformly over the pixel.
vec2 camera_pixel_position(uint pixel, uint sample_index) {
    uint width = scene_frame().width;
    vec2 corner = vec2(pixel % width, pixel / width);
    return corner + random_place(pixel, sample_index, RANDOM_CAMERA_X);
}

// Returns the ray of a sample through a place of its own on the lens. Places are distributed uniformly on a
// disk, as are the projections of cosine-distributed directions. The ray meets `ray`, which goes through the
// centre of the lens, in the plane in focus.
Ray camera_through_lens(Ray ray, uint pixel, uint sample_index) {
    Frame frame = scene_frame();
    if (!(frame.lens_radius > 0.0)) return ray;
    vec2 random = random_vec4(pixel, sample_index, RANDOM_LENS_U).xy;
    vec2 place = cosine_hemisphere(random).xy * frame.lens_radius;
    vec3 offset = frame.camera_right * place.x + frame.camera_up * place.y;
    float depth = dot(ray.direction, frame.camera_forward);
    ray.origin += offset;
    ray.direction = normalize(ray.direction - offset * (depth / frame.focus_distance));
    return ray;
}

#endif

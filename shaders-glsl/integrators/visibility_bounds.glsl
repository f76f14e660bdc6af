// Finds the bounds of a triangle in the image area of a wave: the pixels whose rays may hit the triangle.
// Reads: push constants, frame. Writes: nothing.
// Source: none.
// The image area that is drawn has the rows of the image in which the wave has pixels. A point of the area is
// given as (x/z, y/z), in units of half its longer side, to the right of and below its centre.
#ifndef INTEGRATORS_VISIBILITY_BOUNDS_GLSL
#define INTEGRATORS_VISIBILITY_BOUNDS_GLSL

#include "integrators/visibility.glsl"
#include "scene/accessors.glsl"

// Bound of the rounding of the triangle test, of camera rays and of the values computed here, divided by the
// largest length involved: 64 units of rounding.
const float ROUNDING = 3.9e-6;

// Image area of a wave.
struct Area {
    vec2 size;            // width and height, pixels
    float row;            // row of the area's centre in the image, pixels from the top
    float half_side;      // half of the longer side, pixels
};

// Returns the area of the wave.
Area wave_area(Frame frame) {
    uint first = visibility.first_pixel / frame.width;
    uint last = (visibility.first_pixel + visibility.pixel_count - 1u) / frame.width;
    vec2 size = vec2(frame.width, last - first + 1u);
    return Area(size, float(first) + 0.5 * size.y, 0.5 * max(size.x, size.y));
}

// Returns how many pixels wide and high a metre is at depth 1; in a parallel projection at any depth.
vec2 pixels_per_metre(Frame frame) {
    return vec2(0.5 * float(frame.width) / frame.half_width, 0.5 * float(frame.height) / frame.half_height);
}

// Transforms a point that is relative to the camera, so that (x/z, y/z) is its place in the area.
vec3 area_from_camera(Frame frame, Area area, vec3 p) {
    vec2 pixels = vec2(dot(frame.camera_right, p), -dot(frame.camera_up, p)) * pixels_per_metre(frame);
    float z = frame.projection == PROJECTION_PERSPECTIVE ? dot(frame.camera_forward, p) : 1.0;
    pixels.y += z * (0.5 * float(frame.height) - area.row);
    return vec3(pixels / area.half_side, z);
}

// True if all corners lie beyond one side of a rectangle around the centre, by more than `rounding`. The test
// also holds for corners behind the eye: it is true only if no part of the triangle in front of the eye lies
// in the rectangle.
bool is_beyond(vec3 a, vec3 b, vec3 c, vec2 half_size, float rounding) {
    vec3 x = vec3(a.x, b.x, c.x);
    vec3 y = vec3(a.y, b.y, c.y);
    vec3 z = vec3(a.z, b.z, c.z);
    vec3 slack = vec3(rounding);
    return all(greaterThan(x - half_size.x * z, slack)) || all(greaterThan(-x - half_size.x * z, slack))
        || all(greaterThan(y - half_size.y * z, slack)) || all(greaterThan(-y - half_size.y * z, slack));
}

// Finds the bounds (lower, upper) in the area of the centres of all pixels whose rays may hit the triangle.
// `margin` is the largest distance of such a centre from the triangle; it is 0 if the triangle reaches behind
// the eye, and the bounds are then the whole area. Returns false if there are no such pixels. Corners are
// relative to the camera; `placed` are their places in the area.
bool propose(Frame frame, Area area, vec3 corners[3], out vec3 placed[3], out vec4 bounds, out float margin) {
    float reach = max(length(corners[0]), max(length(corners[1]), length(corners[2])));
    bool perspective = frame.projection == PROJECTION_PERSPECTIVE;
    // The origins of parallel rays are rounded as well.
    float rounding = ROUNDING * (perspective ? reach : reach + length(frame.camera_position) + frame.half_width + frame.half_height);
    vec3 depths;
    for (int k = 0; k < 3; k++) {
        placed[k] = area_from_camera(frame, area, corners[k]);
        depths[k] = dot(frame.camera_forward, corners[k]);
    }
    vec2 sides = area.size / (2.0 * area.half_side);
    bounds = vec4(-sides, sides);
    margin = 0.0;
    if (all(lessThan(depths, vec3(-rounding)))) {
        return false;
    }
    vec2 scale = pixels_per_metre(frame) / area.half_side;
    float rounding_placed = rounding * max(max(scale.x, scale.y), 1.0);
    if (is_beyond(placed[0], placed[1], placed[2], sides, rounding_placed)) {
        return false;
    }
    float nearest = perspective ? min(depths.x, min(depths.y, depths.z)) : 1.0;
    if (perspective && !(nearest > 1.0e-6 * reach)) {
        return true;
    }
    // The margin is half a pixel, from the centre to the sides, and 1/16 of a pixel for the hardware's
    // sub-pixel grid, which has at least 16 steps per pixel.
    margin = (0.5 + 1.0 / 16.0) / area.half_side + rounding_placed / nearest;
    vec2 a = placed[0].xy / placed[0].z;
    vec2 b = placed[1].xy / placed[1].z;
    vec2 c = placed[2].xy / placed[2].z;
    bounds = vec4(max(min(a, min(b, c)) - margin, -sides), min(max(a, max(b, c)) + margin, sides));
    return all(lessThanEqual(bounds.xy, bounds.zw));
}

#endif

// Boxes around objects, from which cells can take their depth bounds in place of fragments. An object is a
// draw: an instance of a mesh. The functions find the words of a box in the bounds pool, behind the bounds of
// cells, the marks and the blocks, and what a view sees of a box.
// Reads: header, geometry, bounds. Writes: bounds, unless STRUCTURE_READ_ONLY is defined.
// Source: MMRT section 3.3, which names bounding boxes as a replacement for the geometry.
#ifndef ABUFFER_BOXES_GLSL
#define ABUFFER_BOXES_GLSL

#include "ads/float_keys.glsl"
#include "ads/geometry.glsl"
#include "abuffer/blocks.glsl"

// Returns the box that contains a triangle. If there are more draws than boxes, several consecutive draws
// share one.
uint abuffer_box_of(uint primitive) {
    uint draws = max(geometry_header.draw_count, 1u);
    return geometry_draw(primitive) / ((draws + ABUFFER_BOXES - 1u) / ABUFFER_BOXES);
}

// Returns the first word of a box. Three words hold the complements of the keys of the lower corner, and
// three the keys of the upper corner. So atomicMax widens all six words, and a cleared box is empty.
uint abuffer_box_word(AbufferRef s, uint box) {
    uint base = abuffer_marks(s) + abuffer_mark_sets() * abuffer_mark_words(s);
    if (ABUFFER_MARCH == ABUFFER_MARCH_PYRAMID) {
        base = pyramid_end(abuffer_pyramid_first(s, ABUFFER_HAS_CAMERA ? ABUFFER_CAMERA : 0u));
    }
    return base + ABUFFER_BOX_WORDS * min(box, ABUFFER_BOXES - 1u);
}

#ifndef STRUCTURE_READ_ONLY
// Raises a word to at least `key`. The word is read first, since most triangles do not change it.
void abuffer_widen_box_word(AbufferRef s, uint word, uint key) {
    if (ABUFFER_POOL(s, bounds)[word] < key) {
        atomicMax(ABUFFER_POOL(s, bounds)[word], key);
    }
}

// Widens a box by the bounds of a triangle, in metres relative to the frame origin.
void abuffer_widen_box(AbufferRef s, uint box, vec3 lower, vec3 upper) {
    uint word = abuffer_box_word(s, box);
    for (uint axis = 0u; axis < 3u; axis++) {
        abuffer_widen_box_word(s, word + axis, ~key_of(lower[axis]));
        abuffer_widen_box_word(s, word + 3u + axis, key_of(upper[axis]));
    }
}
#endif

// Returns the corners of a box in metres relative to the frame origin. Returns false if the box is empty.
bool abuffer_box(AbufferRef s, uint box, out vec3 lower, out vec3 upper) {
    uint word = abuffer_box_word(s, box);
    for (uint axis = 0u; axis < 3u; axis++) {
        lower[axis] = float_of(~ABUFFER_POOL(s, bounds)[word + axis]);
        upper[axis] = float_of(ABUFFER_POOL(s, bounds)[word + 3u + axis]);
    }
    return ABUFFER_POOL(s, bounds)[word + 3u] != 0u;
}

// Returns how far rounding may move, in a view, a point of a box against a corner of a triangle in the box.
// The corners of the box are relative to the eye. Turning a point into a face is exact, so faces need no such
// margin.
vec3 abuffer_box_rounding(AbufferRef s, uint view, vec3 lower, vec3 upper) {
    if (view != ABUFFER_CAMERA) {
        return vec3(0.0);
    }
    vec3 reach = max(abs(lower), abs(upper));
    vec3 sums = vec3(dot(abs(ABUFFER_HEADER(s).camera_x), reach), dot(abs(ABUFFER_HEADER(s).camera_y), reach),
        dot(abs(ABUFFER_HEADER(s).camera_z), reach));
    return 1.0e-6 * sums;
}

// Finds where a view sees a box, whose corners are relative to the eye. `first` and `last` are its corners
// along the axes of the view. `bounds` are the lower and upper x/z and y/z of the cells whose centres the
// contents of the box may cover. Returns false if there are no such cells.
bool abuffer_see_box(AbufferRef s, uint view, vec3 lower, vec3 upper, out vec3 first, out vec3 last, out vec4 bounds) {
    float side = float(abuffer_resolution(s, view));
    float limit = 1.0 + 2.0 / side;
    const float far = 3.0e38;
    first = vec3(far);
    last = vec3(-far);
    vec4 places = vec4(far, far, -far, -far);
    for (uint corner = 0u; corner < 8u; corner++) {
        bvec3 is_upper = bvec3((corner & 1u) != 0u, (corner & 2u) != 0u, (corner & 4u) != 0u);
        vec3 p = abuffer_view_from_world(s, mix(lower, upper, is_upper), view);
        first = min(first, p);
        last = max(last, p);
        vec2 place = p.xy / p.z;
        places = vec4(min(places.xy, place), max(places.zw, place));
    }
    vec3 rounding = abuffer_box_rounding(s, view, lower, upper);
    first -= rounding;
    last += rounding;
    bounds = vec4(-limit, -limit, limit, limit);
    // A box that contains the eye, or reaches the plane through the eye, may be seen in any cell.
    if (first.z > 1.0e-6 * last.z) {
        // The margin is 1/32 of a cell, for the hardware's sub-pixel grid, and the rounding.
        vec2 margin = 1.0 / (16.0 * side) + 1.0e-6 + (rounding.xy + limit * rounding.z) / first.z;
        bounds = vec4(max(places.xy - margin, bounds.xy), min(places.zw + margin, bounds.zw));
    }
    return last.z > 0.0 && bounds.x <= bounds.z && bounds.y <= bounds.w;
}

#endif

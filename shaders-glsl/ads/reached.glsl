// The depths of a triangle in a cell that it reaches into, of the view that it faces most, as one word by which lists
// are sorted: their middle, and in its last two bits how far they reach from it.
// Reads, writes: nothing.
// Source: not in the papers, whose cells keep depths at their centres.
#ifndef ADS_REACHED_GLSL
#define ADS_REACHED_GLSL

#include "ads/axis_views.glsl"

// Word of a triangle that may be hit at any depth of its cell, because rounding leaves the place of its plane
// open. It is the lowest of all words, so that such triangles are first in sorted lists.
#define REACHED_ANY_DEPTH 0.0

// Returns the middle of the depths that a triangle has in a cell that it reaches into, and half their span in
// `span`; of all its depths if rounding leaves those in the cell open. a, b, c are in the frame of a view,
// which the triangle faces most. It is precise, since all builders store equal values.
float reached_depth(AxisView view, vec3 a, vec3 b, vec3 c, ivec2 cell, out float span) {
    float nearest = min(a.z, min(b.z, c.z));
    float farthest = max(a.z, max(b.z, c.z));
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    precise vec3 normal = abs(ab.yzx * ac.zxy - ab.zxy * ac.yzx);
    precise float rise = min(0.5 * (normal.x + normal.y) / max(normal.z, 1.0e-30), 1.0) * view.cell;
    rise = axis_depth_is_certain(view, a, b, c, cell) ? rise : farthest - nearest;
    float z = clamp(axis_plane_depth(a, b, c, axis_center(view, cell).xy), nearest, farthest);
    precise float low = clamp(z - rise, nearest, farthest);
    precise float high = clamp(z + rise, nearest, farthest);
    precise float half_span = 0.5 * (high - low);
    span = half_span;
    precise float middle = low + half_span;
    return middle;
}

// Returns the word of a triangle with these depths: half the span is an eighth of a cell, a quarter, a half
// or all of one; REACHED_ANY_DEPTH if it is more.
float reached_word(AxisView view, float middle, float span) {
    if (span > 1.001 * view.cell) {
        return REACHED_ANY_DEPTH;
    }
    precise vec3 spans = vec3(0.125, 0.25, 0.5) * view.cell;
    uint size = span <= spans.x ? 0u : (span <= spans.y ? 1u : (span <= spans.z ? 2u : 3u));
    return uintBitsToFloat((floatBitsToUint(max(middle, 1.0e-30)) & ~3u) | size);
}

// Returns how much less than a cell the depths of a word reach from their middle, as a share of a cell.
float reached_less(float word) {
    return 1.0 - 0.125 * float(1u << (floatBitsToUint(word) & 3u));
}

#endif

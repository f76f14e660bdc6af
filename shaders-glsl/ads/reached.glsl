// The depths of a triangle in a cell that it reaches into, as one word by which lists are sorted. The word is
// the middle of the depths, with their span in the last two bits.
// Reads, writes: nothing.
// Source: not in the papers, whose cells store depths at their centres.
#ifndef ADS_REACHED_GLSL
#define ADS_REACHED_GLSL

#include "ads/axis_views.glsl"

// Word of a triangle that may be hit at any depth of its cell, because rounding leaves the position of its
// plane open. This is the lowest of all words, so such triangles are first in sorted lists.
#define REACHED_ANY_DEPTH 0.0

// Returns the middle of the depths that a triangle has in a cell that it reaches into; gives half their span
// in `span`. If rounding leaves these depths open, takes all depths of the triangle instead. a, b, c are in
// the frame of the view that the triangle faces most. The expressions are precise, since all builders must
// store equal values.
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

// Returns the word of a triangle with these depths. It stores half the span as an eighth, a quarter, a half
// or all of a cell, rounded up; it is REACHED_ANY_DEPTH if half the span is more than a cell.
float reached_word(AxisView view, float middle, float span) {
    if (span > 1.001 * view.cell) {
        return REACHED_ANY_DEPTH;
    }
    precise vec3 spans = vec3(0.125, 0.25, 0.5) * view.cell;
    uint size = span <= spans.x ? 0u : (span <= spans.y ? 1u : (span <= spans.z ? 2u : 3u));
    return uintBitsToFloat((floatBitsToUint(max(middle, 1.0e-30)) & ~3u) | size);
}

// Returns by how much less than a cell the depths of a word reach from their middle, as a share of a cell.
float reached_less(float word) {
    return 1.0 - 0.125 * float(1u << (floatBitsToUint(word) & 3u));
}

#endif

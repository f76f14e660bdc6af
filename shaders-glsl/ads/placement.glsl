// Places views and cells, given the bounds of a geometry and an eye. The header pass of each structure calls
// these functions (`from_bounds.glsl`).
// Reads, writes: nothing.
// Positions are in metres relative to the frame origin.
// Source: none; docs/core.md.
#ifndef ADS_PLACEMENT_GLSL
#define ADS_PLACEMENT_GLSL

#include "ads/constants.glsl"

float largest_axis(vec3 v) {
    return max(v.x, max(v.y, v.z));
}

// Returns the largest distance of a box from the origin along an axis.
float box_reach(vec3 lower, vec3 upper) {
    return max(largest_axis(abs(lower)), largest_axis(abs(upper)));
}

// Returns the centre of faces for an eye and for geometry within bounds. It is the eye itself if the eye is
// within the bounds or the bounds are flat. Otherwise it is the point nearest to the eye within about the
// inner half of the bounds, moved back towards the eye as far as rays from the eye need. Seen from an eye
// outside, all geometry would lie in a small part of the faces, and the farther away the eye, the fewer tiles
// it would fill.
vec3 centre_within(vec3 eye, vec3 lower, vec3 upper) {
    precise vec3 extent = upper - lower;
    float longest = largest_axis(extent);
    // If the length of a side overflows, the centre is the eye.
    bool has_inside = all(greaterThan(extent, vec3(PLACEMENT_FLATTEST * longest))) && longest <= PLACEMENT_LONGEST;
    bool is_inside = all(lessThanEqual(lower, eye)) && all(lessThanEqual(eye, upper));
    if (is_inside || !has_inside) {
        return eye;
    }
    precise vec3 margin = PLACEMENT_MARGIN * extent;
    precise vec3 within = min(max(eye, lower + margin), upper - margin);
    precise vec3 from_eye = eye - within;
    precise vec3 to_sides = max(upper - within, within - lower);
    float away = largest_axis(abs(from_eye));
    float reach = largest_axis(to_sides);
    // The largest distance of the geometry from the centre is at least `reach`, and at least the distance by
    // which the centre is moved.
    precise float back = max(min(away - PLACEMENT_EYE_LIMIT * reach, away / (PLACEMENT_EYE_LIMIT + 1.0)), 0.0);
    precise vec3 centre = within + from_eye * (back / away);
    return centre;
}

// Returns the centre of faces for geometry within bounds, for any eye: about the middle of the bounds. Along
// an axis in which the bounds are flat, it lies beside them, at a distance of half their longest side.
vec3 centre_of_bounds(vec3 lower, vec3 upper) {
    precise vec3 extent = upper - lower;
    float longest = largest_axis(extent);
    precise vec3 middle = (1.0 - PLACEMENT_MIDDLE) * lower + PLACEMENT_MIDDLE * upper;
    precise vec3 beside = upper + 0.5 * longest;
    // A side whose length overflows does not count as flat.
    bvec3 is_flat = lessThan(extent, vec3(longest <= PLACEMENT_LONGEST ? PLACEMENT_FLATTEST * longest : 0.0));
    return mix(middle, beside, is_flat);
}

// Returns the lower corner (xyz) and the side (w) of a cube that holds the bounds. The cube is a little wider
// than the longest side, so that no side of the geometry lies on a side of the cube.
vec4 cube_placement(vec3 lower, vec3 upper) {
    precise float widened = max(largest_axis(upper - lower) * PLACEMENT_WIDENED, PLACEMENT_SMALLEST);
    // Rounding must not move the corner into the geometry, and it may move the corner away from the far end.
    precise vec3 corner = min(0.5 * lower + 0.5 * upper - 0.5 * widened, lower);
    precise float rounded = max(widened, largest_axis(upper - corner));
    return vec4(corner, uintBitsToFloat(floatBitsToUint(rounded) + 1u));
}

// The placement of a box of cells along the axes of the world, for ads/box_cells.glsl.
struct BoxPlacement {
    vec3 centre;          // middle of the bounds, metres
    float reach;          // half the longest side of the bounds, metres; more if rays start far away
    float rounding;       // how far a ray may pass from a triangle that it is found to hit, metres
    vec3 lower;           // lower corner of the first cell, metres relative to the centre
    vec3 per_metre;       // cells per metre along each axis
};

// Places `cells` cells along each axis, 1 or more, over the bounds. Rays may start around the eye, and
// anywhere within the bounds `around`, which are those of the whole geometry if the cells are for a part. The
// cells reach PLACEMENT_BELOW margins below the bounds and PLACEMENT_ABOVE margins above them, so that
// neither the sides nor the middle of the bounds lie on a plane between cells. If bounds without thickness
// are cut into 4 cells, they lie in the middle of the second cell.
BoxPlacement box_placement(vec3 lower, vec3 upper, vec3 around_lower, vec3 around_upper, uvec3 cells, vec3 eye) {
    precise vec3 centre = 0.5 * lower + 0.5 * upper;
    precise vec3 first = lower - centre;
    precise vec3 last = upper - centre;
    precise vec3 eye_offset = eye - centre;
    precise vec3 around_first = around_lower - centre;
    precise vec3 around_last = around_upper - centre;
    float away = max(largest_axis(abs(eye_offset)), box_reach(around_first, around_last));
    float own = max(box_reach(first, last), PLACEMENT_SMALLEST);
    float most = float(max(cells.x, max(cells.y, cells.z)));
    // Margins for distant rays are limited to a share of a cell.
    precise float limit = (2.0 * PLACEMENT_WIDEST_MARGIN / CELL_ROUNDING) * own / most;
    float reach = max(min(away / PLACEMENT_EYE_LIMIT, limit), own);
    precise float rounding = CELL_ROUNDING * reach;
    // The values are halved so that their sum does not overflow.
    precise vec3 half_extent = 0.5 * last - 0.5 * first + 0.5 * (PLACEMENT_BELOW + PLACEMENT_ABOVE) * rounding;
    precise vec3 per_metre = 0.5 * vec3(cells) / half_extent;
    precise vec3 corner = first - PLACEMENT_BELOW * rounding;
    return BoxPlacement(centre, reach, rounding, corner, per_metre);
}

#endif

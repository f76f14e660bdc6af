// Places views and cells for the bounds of a geometry and an eye: functions of values, for the header pass of
// each structure (`from_bounds.glsl`).
// Reads, writes: nothing. Metres relative to the frame origin.
// Source: none; docs/core.md.
#ifndef ADS_PLACEMENT_GLSL
#define ADS_PLACEMENT_GLSL

#include "ads/constants.glsl"

float largest_axis(vec3 v) {
    return max(v.x, max(v.y, v.z));
}

// Returns the maximum distance of a box from the origin along an axis.
float box_reach(vec3 lower, vec3 upper) {
    return max(largest_axis(abs(lower)), largest_axis(abs(upper)));
}

// Returns the centre of faces for an eye and geometry within bounds: the eye itself if it is within them or
// if they are flat; otherwise the point of about their inner half that is nearest to the eye, moved back
// towards it as far as rays from there need. From an eye outside, all geometry lies in a part of the faces:
// the farther away the eye, the fewer tiles.
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
    // The geometry is at least as far from the centre as the centre was moved, and as `reach`.
    precise float back = max(min(away - PLACEMENT_EYE_LIMIT * reach, away / (PLACEMENT_EYE_LIMIT + 1.0)), 0.0);
    precise vec3 centre = within + from_eye * (back / away);
    return centre;
}

// Returns the centre of faces for geometry within bounds, wherever the eye is: about the middle of the
// bounds, and for flat bounds beside them, at a distance of half their longest side.
vec3 centre_of_bounds(vec3 lower, vec3 upper) {
    precise vec3 extent = upper - lower;
    float longest = largest_axis(extent);
    precise vec3 middle = (1.0 - PLACEMENT_MIDDLE) * lower + PLACEMENT_MIDDLE * upper;
    precise vec3 beside = upper + 0.5 * longest;
    // A side whose length overflows counts as thick.
    bvec3 is_flat = lessThan(extent, vec3(longest <= PLACEMENT_LONGEST ? PLACEMENT_FLATTEST * longest : 0.0));
    return mix(middle, beside, is_flat);
}

// Returns the lower corner (xyz) and side (w) of a cube that holds the bounds, a little wider than their
// longest side, so that no side of the geometry lies on a side of the cube.
vec4 cube_placement(vec3 lower, vec3 upper) {
    precise float widened = max(largest_axis(upper - lower) * PLACEMENT_WIDENED, PLACEMENT_SMALLEST);
    // Rounding must not move the corner into the geometry, and may move it away from the far end.
    precise vec3 corner = min(0.5 * lower + 0.5 * upper - 0.5 * widened, lower);
    precise float rounded = max(widened, largest_axis(upper - corner));
    return vec4(corner, uintBitsToFloat(floatBitsToUint(rounded) + 1u));
}

// Cells of one box along the axes of the world, as ads/box_cells.glsl uses them.
struct BoxPlacement {
    vec3 centre;          // middle of the bounds
    float reach;          // half the longest side of the bounds; more where rays start far away
    float rounding;       // how far a ray may be from a triangle that it hits
    vec3 lower;           // corner of the first cell relative to the centre
    vec3 per_metre;       // cells
};

// Places this number of cells along each axis, 1 or more, over the bounds, for rays from around the eye and
// from everywhere within the bounds around them: those of the whole geometry if the cells are of a part. The
// cells reach PLACEMENT_BELOW margins below the bounds and PLACEMENT_ABOVE above, so that the sides lie well
// within a cell, and so does the middle. Bounds without thickness, cut into 4 cells, are in the middle of the
// second.
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
    // Halves keep the values within the range of numbers.
    precise vec3 half_extent = 0.5 * last - 0.5 * first + 0.5 * (PLACEMENT_BELOW + PLACEMENT_ABOVE) * rounding;
    precise vec3 per_metre = 0.5 * vec3(cells) / half_extent;
    precise vec3 corner = first - PLACEMENT_BELOW * rounding;
    return BoxPlacement(centre, reach, rounding, corner, per_metre);
}

#endif

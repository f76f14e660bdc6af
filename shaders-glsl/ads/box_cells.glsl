// The planes between the cells of a box along the axes of the world, and where a ray intersects them. All
// cells have one size; the box counts as a view along z with columns, rows and slices.
// Reads, writes: nothing.
// A cell is one unit wide, so planes are at whole numbers. Nothing else is exact. With R half the longest
// side of the geometry and u = 2^-24, every position below is within 48 u R metres of its exact value for
// origins up to 4 R away. Cells therefore list triangles within that distance.
#ifndef ADS_BOX_CELLS_GLSL
#define ADS_BOX_CELLS_GLSL

// Layout of the cells. Precise expressions take values from a local copy of this record: with device
// addresses, glslang does not end if such expressions follow a reference.
struct BoxCells {
    vec3 lower;           // lower corner of the first cell, metres from the centre
    vec3 per_metre;       // cells per metre
    // how far a ray may pass from a triangle that it is found to hit, by the rounding of test and march,
    // metres
    float rounding;
};

// A ray in units of cells.
struct BoxLine {
    vec3 origin;          // from the lower corner of the first cell
    vec3 direction;       // cells per unit of t
    vec3 inverse;         // reciprocal of the direction; 0 where a component is 0 or subnormal
};

BoxLine box_line(BoxCells axes, vec3 origin, vec3 direction) {
    BoxLine line;
    line.origin = (origin - axes.lower) * axes.per_metre;
    line.direction = direction * axes.per_metre;
    line.inverse = mix(vec3(0.0), 1.0 / line.direction, greaterThanEqual(abs(line.direction), vec3(1.1754944e-38)));
    return line;
}

// Returns the t at which the ray intersects each of three planes: those below column planes.x, row planes.y
// and slice planes.z; infinity for a plane that the ray is parallel to.
vec3 box_line_exits(BoxLine line, ivec3 planes) {
    vec3 t = (vec3(planes) - line.origin) * line.inverse;
    return mix(t, vec3(uintBitsToFloat(0x7F800000u)), equal(line.inverse, vec3(0.0)));
}

// Returns the cell that the ray is in at t. If the ray is outside the grid, returns the nearest cell of the
// grid.
ivec3 box_line_cell_at(BoxLine line, float t, ivec3 cells) {
    // The place is clamped before the conversion, since integers must be less than 2^31.
    return ivec3(clamp(line.origin + t * line.direction, vec3(0.0), vec3(cells) - 0.5));
}

#endif

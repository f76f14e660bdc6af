// The planes between cells of one box of columns, rows and slices along the axes of the world: a view along z
// in which all cells have one size.
// Reads, writes: nothing.
// A cell is one unit wide, so planes are whole numbers. Nothing else is exact: with R half the longest side
// of the geometry and u = 2^-24, every position below is within 48 u R metres of its exact value for origins up to 4 R
// away; cells list what lies within that distance.
#ifndef ADS_BOX_CELLS_GLSL
#define ADS_BOX_CELLS_GLSL

// Layout of the cells. Precise expressions take values from such a local copy: with addresses, glslang does
// not end if they follow a reference.
struct BoxCells {
    vec3 lower;           // metres: corner of the first cell
    vec3 per_metre;       // cells
    float rounding;       // metres: how far a ray may be from a triangle that it hits, by rounding of test and march
};

// Ray in units of cells.
struct BoxLine {
    vec3 origin;
    vec3 direction;       // cells for each unit of t
    vec3 inverse;         // of the direction, 0 where a component is 0 or subnormal
};

BoxLine box_line(BoxCells axes, vec3 origin, vec3 direction) {
    BoxLine line;
    line.origin = (origin - axes.lower) * axes.per_metre;
    line.direction = direction * axes.per_metre;
    line.inverse = mix(vec3(0.0), 1.0 / line.direction, greaterThanEqual(abs(line.direction), vec3(1.1754944e-38)));
    return line;
}

// Returns the t at which the ray intersects each of three planes: below column planes.x, row planes.y, slice
// planes.z.
vec3 box_line_exits(BoxLine line, ivec3 planes) {
    vec3 t = (vec3(planes) - line.origin) * line.inverse;
    return mix(t, vec3(uintBitsToFloat(0x7F800000u)), equal(line.inverse, vec3(0.0)));
}

// Returns the cell that the ray is in at t; outside the grid, the nearest of its cells.
ivec3 box_line_cell_at(BoxLine line, float t, ivec3 cells) {
    // The place is clamped before it becomes an integer, which must be less than 2^31.
    return ivec3(clamp(line.origin + t * line.direction, vec3(0.0), vec3(cells) - 0.5));
}

#endif

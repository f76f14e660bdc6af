// Traverses the squares of a flat grid that a ray crosses, column by column along the ray's major axis.
// Reads, writes: nothing.
// Source: Bürger et al. section 1.4, DDA over pixels; here in closed form.
// Which rows of a column are crossed follows from the column alone, so a traversal can resume at any square.
// The visited squares are a superset of those that are crossed exactly.
#ifndef LDC_MARCH_GLSL
#define LDC_MARCH_GLSL

// LDC_SHIFTED(value, shift) widens a value by a shift, if rounding may have shifted the ray (RIGID).
#ifdef RIGID
// Largest shift of the ray by rounding, in cells. Squares within this distance of the ray are visited, too.
float ldc_spread = 0.0;
#define LDC_SHIFTED(value, shift) ((value) + (shift))
#else
#define LDC_SHIFTED(value, shift) (value)
#endif

// A ray over a view, in units of cells. Columns are along the ray's major axis.
struct LdcFlatRay {
    bool turned;          // true if columns are along the second side of the view
    vec2 origin;          // along columns, then along rows
    vec2 direction;
    float inverse;        // 1 / direction.x, or zero if that is not finite
    // direction of steps, -1 or 1, along columns and along rows
    ivec2 step;
};

// Area of a traversal, in squares along columns and along rows.
struct LdcArea {
    vec2 width;           // of a square, in cells
    ivec2 first;
    ivec2 last;
};

// Traversal of an area. In a column without a row in the area, `rows` is not positive.
struct LdcMarch {
    // squares to traverse
    LdcArea area;
    vec2 t;               // t interval of the ray that is traversed
    int column;
    int row;
    int columns;          // columns that are left, with the current one
    // rows that are left in the current column, with the current one
    int rows;
};

// Returns a ray over a view from its origin and direction along the sides of the view, in cells.
LdcFlatRay ldc_flat_ray(vec2 origin, vec2 direction) {
    LdcFlatRay ray;
    ray.turned = abs(direction.y) > abs(direction.x);
    ray.origin = ray.turned ? origin.yx : origin;
    ray.direction = ray.turned ? direction.yx : direction;
    float inverse = 1.0 / ray.direction.x;
    // Comparisons with infinity and NaN are false.
    ray.inverse = abs(ray.direction.x) > 0.0 && abs(inverse) < 3.0e38 ? inverse : 0.0;
    ray.step = ivec2(ray.direction.x < 0.0 ? -1 : 1, ray.direction.y < 0.0 ? -1 : 1);
    return ray;
}

// Returns the area from one square to another one.
LdcArea ldc_area(LdcFlatRay ray, vec2 width, ivec2 first, ivec2 last) {
    return LdcArea(ray.turned ? width.yx : width, ray.turned ? first.yx : first, ray.turned ? last.yx : last);
}

// Returns the first and the last square along a side (0: columns, 1: rows) that the ray touches, within
// rounding, in a t interval.
ivec2 ldc_touched(LdcFlatRay ray, LdcArea area, int side, vec2 t) {
    float origin = ray.origin[side];
    vec2 moved = ray.direction[side] == 0.0 ? vec2(0.0) : t * ray.direction[side];
    float rounding = 16.0 * FLOAT_ROUNDING * (abs(origin) + max(abs(moved.x), abs(moved.y)));
    float guard = LDC_SHIFTED(rounding, ldc_spread);
    vec2 ends = vec2(origin + min(moved.x, moved.y) - guard, origin + max(moved.x, moved.y) + guard) / area.width[side];
    // The values are clamped as floats, because the conversion of a float that no integer can hold is
    // undefined.
    ivec2 squares = ivec2(floor(clamp(ends, vec2(-1.0), vec2(float(area.last[side] + 1)))));
    return ivec2(max(squares.x, area.first[side]), min(squares.y, area.last[side]));
}

// Finds the rows of the column at which a traversal is.
void ldc_enter_column(LdcFlatRay ray, inout LdcMarch march) {
    vec2 t = march.t;
    if (ray.inverse != 0.0) {
        float from = (float(march.column) * march.area.width.x - ray.origin.x) * ray.inverse;
        float to = (float(march.column + 1) * march.area.width.x - ray.origin.x) * ray.inverse;
        float rounding = FLOAT_ROUNDING * (8.0 * max(abs(from), abs(to)) + 2.0 * abs(ray.origin.x * ray.inverse));
        float slack = LDC_SHIFTED(rounding, ldc_spread * abs(ray.inverse));
        t = vec2(max(t.x, min(from, to) - slack), min(t.y, max(from, to) + slack));
    }
    ivec2 rows = ldc_touched(ray, march.area, 1, t);
    march.row = ray.step.y > 0 ? rows.x : rows.y;
    march.rows = rows.y - rows.x + 1;
}

// Starts a traversal over the t interval [t.x, t.y]. Returns false if the ray does not cross the area.
bool ldc_march_begin(LdcFlatRay ray, LdcArea area, vec2 t, out LdcMarch march) {
    march.area = area;
    march.t = t;
    ivec2 columns = ldc_touched(ray, area, 0, t);
    march.column = ray.step.x > 0 ? columns.x : columns.y;
    march.columns = columns.y - columns.x + 1;
    march.row = 0;
    march.rows = 0;
    if (!(t.x <= t.y) || march.columns <= 0) {
        return false;
    }
    ldc_enter_column(ray, march);
    return true;
}

// Goes to the next square. Returns false at the end.
bool ldc_march_next(LdcFlatRay ray, inout LdcMarch march) {
    march.rows--;
    march.row += ray.step.y;
    if (march.rows > 0) {
        return true;
    }
    march.columns--;
    march.column += ray.step.x;
    if (march.columns <= 0) {
        return false;
    }
    ldc_enter_column(ray, march);
    return true;
}

// Returns the square at which a traversal is. In a column without rows this may be row -1, or the row behind
// the last.
ivec2 ldc_march_square(LdcFlatRay ray, LdcMarch march) {
    return ray.turned ? ivec2(march.row, march.column) : ivec2(march.column, march.row);
}

// Moves a traversal that has begun to a square of an earlier traversal of the same ray.
void ldc_march_resume(LdcFlatRay ray, ivec2 square, inout LdcMarch march) {
    ivec2 place = ray.turned ? square.yx : square;
    march.columns -= abs(place.x - march.column);
    march.column = place.x;
    ldc_enter_column(ray, march);
    march.rows -= abs(place.y - march.row);
    march.row = place.y;
}

#endif

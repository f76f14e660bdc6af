// The watertight ray-triangle test and the depth of a triangle's plane.
// Reads, writes: nothing.
// Source: Woop, Benthin, Wald 2013. Edges are decided by comparing two rounded products, which no contraction
// can change and which two triangles sharing an edge evaluate with the roles swapped, so that one of them
// always accepts. Errors are counted in roundings, gamma_n = n u / (1 - n u), as in pbrt-v4, section 6.8.
#ifndef ADS_TRIANGLE_GLSL
#define ADS_TRIANGLE_GLSL

// Largest divisor that is used; quotients are only known to be close to the truth for divisors below 2^126.
const float TRIANGLE_LARGEST_DIVISOR = 8.0e37;

// Returns the cyclic shift that puts the largest component of `direction` into z. Ties go to x, then y.
uint triangle_major_axis(vec3 direction) {
    vec3 m = abs(direction);
    return m.x >= m.y && m.x >= m.z ? 0u : (m.y >= m.z ? 1u : 2u);
}

vec3 triangle_permute(vec3 p, uint axis) {
    return axis == 0u ? p.yzx : (axis == 1u ? p.zxy : p);
}

// Returns the terms of a triangle's normal, which is as long as twice the area: it is `along - against`. The
// two are kept apart: if they are equal, product by product, contraction cannot make a difference.
void triangle_normal_terms(vec3 a, vec3 b, vec3 c, out vec3 along, out vec3 against) {
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    precise vec3 first = ab.yzx * ac.zxy;
    precise vec3 second = ab.zxy * ac.yzx;
    along = first;
    against = second;
}

// True if a triangle has an area; a triangle without area is never hit.
bool triangle_has_area(vec3 a, vec3 b, vec3 c) {
    vec3 along;
    vec3 against;
    triangle_normal_terms(a, b, c, along, against);
    return any(notEqual(along, against));
}

// The t at which a ray intersects a triangle's plane, and a bound of its error: infinite where rounding decides,
// or where numbers are too small or too large for one. `along`, `against`: of the normal; `p`: a corner
// relative to the origin; `d`: the direction; all with the axes in the same order. Of the axes the last one
// is added last, so that turning the others changes no bit.
//
// With N = |along| + |against| the normal is off by at most 4 u N in each component, its products with p and
// d by 8 u and 7 u of the sums below, and the quotient follows; 12 u covers the rounding of the sums.
void triangle_plane_t(vec3 along, vec3 against, vec3 p, vec3 d, out float t, out float t_error) {
    const float gamma9 = 5.3644210e-7;
    const float gamma12 = 7.1525625e-7;
    // Products that underflow are off by less than this.
    const float tiny = 1.0e-30;
    precise vec3 normal = along - against;
    precise vec3 reach = abs(along) + abs(against);
    precise float facing = (normal.x * d.x + normal.y * d.y) + normal.z * d.z;
    precise float height = (normal.x * p.x + normal.y * p.y) + normal.z * p.z;
    precise float facing_reach = (reach.x * abs(d.x) + reach.y * abs(d.y)) + reach.z * abs(d.z);
    precise float height_reach = (reach.x * abs(p.x) + reach.y * abs(p.y)) + reach.z * abs(p.z);
    precise float certain = abs(facing) - gamma12 * facing_reach;
    precise float quotient = height / facing;
    precise float error = gamma12 * (height_reach + abs(quotient) * facing_reach) / certain + gamma9 * abs(quotient);
    precise float far = (abs(p.x) + abs(p.y)) + abs(p.z);
    precise float fast = (abs(d.x) + abs(d.y)) + abs(d.z);
    bool holds = certain > 0.0 && facing_reach < TRIANGLE_LARGEST_DIVISOR && height_reach > tiny * max(far, 1.0)
        && facing_reach > tiny * max(fast, 1.0);
    t = quotient;
    t_error = holds ? error : uintBitsToFloat(0x7F800000u);
}

// Bounds the error of t = (edges . depths) / sum(edges), infinite where rounding decides whether there is a
// triangle. `x`, `y`: the sheared corners; `dx`, `dy`: how far they may be off; `first`, `second`: the
// products that `edges` are the difference of.
//
// Edges that are off by delta each move t by sum(delta |depth - t|) / |sum of the true edges|: mixing equal
// depths gives that depth whatever the weights. Of rounding, depths, products, sums and the quotient take
// 18 u of sum(|edges depths|), and depth - t itself is off by 24 u of the largest.
float triangle_mixing_error(vec3 x, vec3 y, vec3 dx, vec3 dy, vec3 first, vec3 second, vec3 edges, vec3 depths, float det,
    float t, float max_depth) {
    const float gamma2 = 1.1920930e-7;
    const float gamma24 = 1.4305135e-6;
    precise vec3 wide = abs(x) + dx;
    precise vec3 delta = gamma2 * (abs(first) + abs(second)) + ((wide.zxy * dy.yzx + abs(y.yzx) * dx.zxy)
        + (wide.yzx * dy.zxy + abs(y.zxy) * dx.yzx));
    precise vec3 spread = delta * abs(depths - vec3(t));
    precise vec3 reach = abs(edges * depths);
    precise float lost = delta.x + delta.y + delta.z;
    // The share of `lost` covers the rounding of the two sums.
    precise float certain = abs(det) - 1.001 * lost;
    precise float error = ((spread.x + spread.y + spread.z) + gamma24 * ((reach.x + reach.y + reach.z) + lost * max_depth))
        / certain;
    return certain > 0.0 && abs(det) < TRIANGLE_LARGEST_DIVISOR ? error : uintBitsToFloat(0x7F800000u);
}

// Tests a closed, two-sided triangle against a ray. On acceptance t is in units of |direction|,
// barycentrics are the weights of b and c, and t_error bounds the error of t. A ray in the plane of
// the triangle, or a triangle without area, is not hit. counter_clockwise is the side that the ray meets, by the same
// rounded edges that decide whether it does: so a ray that enters a closed mesh meets as many fronts as backs.
bool triangle_intersect_side(vec3 origin, vec3 direction, vec3 a, vec3 b, vec3 c, out float t, out vec2 barycentrics,
    out float t_error, out bool counter_clockwise) {
    counter_clockwise = true;
    t = 0.0;
    barycentrics = vec2(0.0);
    t_error = 0.0;
    uint axis = triangle_major_axis(direction);
    vec3 d = triangle_permute(direction, axis);
    precise vec3 pa = triangle_permute(a - origin, axis);
    precise vec3 pb = triangle_permute(b - origin, axis);
    precise vec3 pc = triangle_permute(c - origin, axis);
    precise float sx = d.x / d.z;
    precise float sy = d.y / d.z;
    precise float ax = pa.x - sx * pa.z;
    precise float ay = pa.y - sy * pa.z;
    precise float bx = pb.x - sx * pb.z;
    precise float by = pb.y - sy * pb.z;
    precise float cx = pc.x - sx * pc.z;
    precise float cy = pc.y - sy * pc.z;
    // The ray passes at (0, 0). For a triangle that is small compared with its distance from there, all products may
    // round to the same value, and the edge tests alone would accept it. A triangle whose sheared corners hold (0, 0)
    // stays.
    if (min(ax, min(bx, cx)) > 0.0 || max(ax, max(bx, cx)) < 0.0
        || min(ay, min(by, cy)) > 0.0 || max(ay, max(by, cy)) < 0.0) {
        return false;
    }
    vec3 x = vec3(ax, bx, cx);
    vec3 y = vec3(ay, by, cy);
    precise vec3 first = x.zxy * y.yzx;
    precise vec3 second = y.zxy * x.yzx;
    bool front = all(greaterThanEqual(first, second));
    bool back = all(lessThanEqual(first, second));
    if (!front && !back) {
        return false;
    }
    precise vec3 edges = first - second;
    precise float det = edges.x + edges.y + edges.z;
    if (det == 0.0) {
        return false;
    }
    counter_clockwise = (det > 0.0) == (d.z > 0.0);
    // By rounding, a triangle without area may appear to have an area.
    vec3 along;
    vec3 against;
    triangle_normal_terms(a, b, c, along, against);
    if (along == against) {
        return false;
    }
    precise float inverse = 1.0 / det;
    precise vec3 relative = vec3(pa.z, pb.z, pc.z);
    precise vec3 depths = relative / d.z;
    precise float scaled = edges.x * depths.x + edges.y * depths.y + edges.z * depths.z;
    barycentrics = edges.yz * inverse;
    // The exact value lies within the range of the corners.
    float nearest = min(depths.x, min(depths.y, depths.z));
    float farthest = max(depths.x, max(depths.y, depths.z));
    float max_depth = max(abs(nearest), abs(farthest));
    const float gamma3 = 1.7881396e-7;
    const float gamma8 = 4.7683738e-7;
    const float gamma12 = 7.1525625e-7;
    // The shear adds rounding only as far as it moves a corner: a ray almost along the major axis moves none.
    precise vec3 shifted = gamma8 * abs(relative);
    precise vec3 dx = gamma3 * abs(x) + abs(sx) * shifted;
    precise vec3 dy = gamma3 * abs(y) + abs(sy) * shifted;
    precise float mixed_t = clamp(scaled * inverse, nearest, farthest);
    float mixed_error = triangle_mixing_error(x, y, dx, dy, first, second, edges, depths, det, mixed_t, max_depth);
    // Corners are mixed well where they are about as far away as the ray's hit, and a plane is well known
    // where its triangle is not thin: whichever is known better. The bounds are as precise as what they
    // decide about.
    float plane_t;
    float plane_error;
    triangle_plane_t(triangle_permute(along, axis), triangle_permute(against, axis), pa, d, plane_t, plane_error);
    bool by_plane = plane_error < mixed_error;
    t = by_plane ? clamp(plane_t, nearest, farthest) : mixed_t;
    // Both values lie within the corners' range, whose ends have six roundings each.
    precise float range = farthest - nearest + gamma12 * max_depth;
    t_error = min(by_plane ? plane_error : mixed_error, range);
    return true;
}

// Tests as triangle_intersect_side if the side does not matter.
bool triangle_intersect(vec3 origin, vec3 direction, vec3 a, vec3 b, vec3 c, out float t, out vec2 barycentrics,
    out float t_error) {
    bool counter_clockwise;
    return triangle_intersect_side(origin, direction, a, b, c, t, barycentrics, t_error, counter_clockwise);
}

// Returns the barycentrics of b and c for the point of the triangle's plane below `p`; they may lie outside
// [0, 1]. They are zero if the triangle has no area.
vec2 triangle_barycentrics(vec3 p, vec3 a, vec3 b, vec3 c) {
    vec3 ab = b - a;
    vec3 ac = c - a;
    vec3 normal = cross(ab, ac);
    float squared = dot(normal, normal);
    vec2 weights = vec2(dot(cross(p - a, ac), normal), dot(cross(ab, p - a), normal));
    return squared > 0.0 ? weights / squared : vec2(0.0);
}

// Intersects a ray with the plane of a triangle: t, and the barycentrics of b and c there, which may lie
// outside [0, 1]. False if the ray runs in or parallel to the plane, or the triangle has no area.
bool triangle_plane(vec3 origin, vec3 direction, vec3 a, vec3 b, vec3 c, out float t, out vec2 barycentrics) {
    vec3 normal = cross(b - a, c - a);
    float facing = dot(normal, direction);
    t = 0.0;
    barycentrics = vec2(0.0);
    if (facing == 0.0) {
        return false;
    }
    t = dot(normal, a - origin) / facing;
    barycentrics = triangle_barycentrics(origin + t * direction, a, b, c);
    return dot(normal, normal) > 0.0;
}

// Returns the point of a flat triangle's border that is nearest to a point.
vec2 triangle_nearest_point(vec2 a, vec2 b, vec2 c, vec2 p) {
    vec2 from[3] = vec2[3](a, b, c);
    vec2 to[3] = vec2[3](b, c, a);
    vec2 nearest = a;
    for (int edge = 0; edge < 3; edge++) {
        vec2 span = to[edge] - from[edge];
        float squared = dot(span, span);
        float share = squared > 0.0 ? clamp(dot(p - from[edge], span) / squared, 0.0, 1.0) : 0.0;
        vec2 candidate = from[edge] + share * span;
        nearest = dot(candidate - p, candidate - p) < dot(nearest - p, nearest - p) ? candidate : nearest;
    }
    return nearest;
}

#endif

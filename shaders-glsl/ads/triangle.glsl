// The watertight test of a ray against a triangle, and the depth of a triangle's plane.
// Reads, writes: nothing.
// Source: Woop, Benthin, Wald 2013. The side of an edge on which a ray passes is decided by a comparison of
// two rounded products. Contraction cannot change the result, and two triangles that share an edge compare
// the same products with their roles swapped, so that one of the triangles always accepts. Errors are counted
// in roundings, with gamma_n = n u / (1 - n u) as in pbrt-v4, section 6.8.
#ifndef ADS_TRIANGLE_GLSL
#define ADS_TRIANGLE_GLSL

// Largest divisor that is used: quotients are only known to be accurate for divisors below 2^126.
const float TRIANGLE_LARGEST_DIVISOR = 8.0e37;

// Returns the axis of the largest component of `direction`, which triangle_permute makes the last one. Of
// equal components x comes first, then y.
uint triangle_major_axis(vec3 direction) {
    vec3 m = abs(direction);
    return m.x >= m.y && m.x >= m.z ? 0u : (m.y >= m.z ? 1u : 2u);
}

// Permutes the axes cyclically so that `axis` becomes z.
vec3 triangle_permute(vec3 p, uint axis) {
    return axis == 0u ? p.yzx : (axis == 1u ? p.zxy : p);
}

// Returns the two terms of a triangle's normal, which is `along - against` and as long as twice the area.
// They are kept apart because contraction cannot change whether two products are equal, whereas it may change
// whether their difference is 0.
void triangle_normal_terms(vec3 a, vec3 b, vec3 c, out vec3 along, out vec3 against) {
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    precise vec3 first = ab.yzx * ac.zxy;
    precise vec3 second = ab.zxy * ac.yzx;
    along = first;
    against = second;
}

// True if a triangle has an area. A triangle without area is never hit.
bool triangle_has_area(vec3 a, vec3 b, vec3 c) {
    vec3 along;
    vec3 against;
    triangle_normal_terms(a, b, c, along, against);
    return any(notEqual(along, against));
}

// Computes t at which a ray intersects a triangle's plane, and a bound of the error of t. The bound is
// infinite if rounding decides the result, or if numbers are too small or too large for a bound. `along` and
// `against` are the terms of the normal, `p` is a corner relative to the ray's origin and `d` the direction,
// all with their axes in the same order. The last axis is added last, so exchanging the others changes no
// bit.
//
// With N = |along| + |against|, the normal is off by at most 4 u N in each component. Its products with p and
// d are off by 8 u and 7 u of the sums below, and the error of the quotient follows from these. 12 u includes
// the rounding of the sums.
void triangle_plane_t(vec3 along, vec3 against, vec3 p, vec3 d, out float t, out float t_error) {
    const float gamma9 = 5.3644210e-7;
    const float gamma12 = 7.1525625e-7;
    // Products that underflow are off by less than this number.
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

// Bounds the error of t = dot(edges, depths) / sum(edges). The bound is infinite if rounding decides whether
// the triangle is hit. `x` and `y` are the sheared corners, `dx` and `dy` bounds of their errors; `edges` is
// the difference of the products `first` and `second`.
//
// If each edge is off by its delta, t is off by sum(delta |depth - t|) / |sum of the true edges|: a mix of
// equal depths is that depth, whatever the weights. The rounding of depths, products, sums and the quotient
// is at most 18 u of sum(|edges depths|), and depth - t itself is off by 24 u of the largest depth.
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
    // The factor of `lost` covers the rounding of the two sums.
    precise float certain = abs(det) - 1.001 * lost;
    precise float error = ((spread.x + spread.y + spread.z) + gamma24 * ((reach.x + reach.y + reach.z) + lost * max_depth))
        / certain;
    return certain > 0.0 && abs(det) < TRIANGLE_LARGEST_DIVISOR ? error : uintBitsToFloat(0x7F800000u);
}

// Tests a ray against a triangle, which is closed and has two sides. If the function returns true, t is in
// units of the direction's length, the barycentrics are the weights of b and c, t_error bounds the error of
// t, and counter_clockwise tells which side the ray meets. A ray in the plane of the triangle does not hit
// it, and a triangle without area is not hit. The side is decided by the same rounded edges as the hit, so a
// ray that passes through a closed mesh meets as many fronts as backs.
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
    // The ray is at (0, 0) in sheared space. If a triangle is small compared with its distance from (0, 0),
    // all products may round to the same value, and the edge tests alone would accept it. This test rejects
    // triangles whose sheared corners all lie on one side of (0, 0) along x or y, so it rejects no triangle
    // that contains (0, 0).
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
    // Because of rounding, a triangle without area may appear to have one here.
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
    // The exact t lies within the range of the corners' depths.
    float nearest = min(depths.x, min(depths.y, depths.z));
    float farthest = max(depths.x, max(depths.y, depths.z));
    float max_depth = max(abs(nearest), abs(farthest));
    const float gamma3 = 1.7881396e-7;
    const float gamma8 = 4.7683738e-7;
    const float gamma12 = 7.1525625e-7;
    // Shearing adds rounding only as far as it moves a corner. If the ray runs almost along the major axis,
    // it moves none.
    precise vec3 shifted = gamma8 * abs(relative);
    precise vec3 dx = gamma3 * abs(x) + abs(sx) * shifted;
    precise vec3 dy = gamma3 * abs(y) + abs(sy) * shifted;
    precise float mixed_t = clamp(scaled * inverse, nearest, farthest);
    float mixed_error = triangle_mixing_error(x, y, dx, dy, first, second, edges, depths, det, mixed_t, max_depth);
    // t is known well from the corners' depths if these are about as far away as the hit, and from the plane
    // if the triangle is not thin. The t with the smaller bound of its error is taken. The bounds are
    // computed with `precise`, too, since they decide which t it is.
    float plane_t;
    float plane_error;
    triangle_plane_t(triangle_permute(along, axis), triangle_permute(against, axis), pa, d, plane_t, plane_error);
    bool by_plane = plane_error < mixed_error;
    t = by_plane ? clamp(plane_t, nearest, farthest) : mixed_t;
    // Both values of t lie within the range of the corners' depths, whose ends have six roundings each.
    precise float range = farthest - nearest + gamma12 * max_depth;
    t_error = min(by_plane ? plane_error : mixed_error, range);
    return true;
}

// Does what triangle_intersect_side does, for callers to whom the side does not matter.
bool triangle_intersect(vec3 origin, vec3 direction, vec3 a, vec3 b, vec3 c, out float t, out vec2 barycentrics,
    out float t_error) {
    bool counter_clockwise;
    return triangle_intersect_side(origin, direction, a, b, c, t, barycentrics, t_error, counter_clockwise);
}

// Returns the barycentrics of b and c for the point of the triangle's plane that is nearest to `p`. They may
// lie outside [0, 1]; they are 0 if the triangle has no area.
vec2 triangle_barycentrics(vec3 p, vec3 a, vec3 b, vec3 c) {
    vec3 ab = b - a;
    vec3 ac = c - a;
    vec3 normal = cross(ab, ac);
    float squared = dot(normal, normal);
    vec2 weights = vec2(dot(cross(p - a, ac), normal), dot(cross(ab, p - a), normal));
    return squared > 0.0 ? weights / squared : vec2(0.0);
}

// Intersects a ray with the plane of a triangle: gives t, and the barycentrics of b and c there, which may
// lie outside [0, 1]. Returns false if the ray is parallel to the plane, or if the triangle has no area.
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

// Returns the point on the edges of a flat triangle that is nearest to a point.
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

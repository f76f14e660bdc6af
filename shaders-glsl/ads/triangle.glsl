// What: the watertight ray-triangle test and the depth of a triangle's plane.
// Reads, writes: nothing.
// Source: Woop, Benthin, Wald 2013. Edges are decided by comparing two rounded products, which no
// contraction can change and which two triangles sharing an edge evaluate with the roles swapped, so
// that one of them always accepts. Error bound of t after pbrt-v4, section 6.8, with the shear's own share.
#ifndef ADS_TRIANGLE_GLSL
#define ADS_TRIANGLE_GLSL

// Cyclic shift that puts the largest component of `direction` into z. Ties go to x, then y.
uint triangle_major_axis(vec3 direction) {
    vec3 m = abs(direction);
    return m.x >= m.y && m.x >= m.z ? 0u : (m.y >= m.z ? 1u : 2u);
}

vec3 triangle_permute(vec3 p, uint axis) {
    return axis == 0u ? p.yzx : (axis == 1u ? p.zxy : p);
}

// The normal of a triangle, as long as twice its area, is `along - against`. The two are kept apart: where they are equal,
// product by product, contraction cannot make a difference.
void triangle_normal_terms(vec3 a, vec3 b, vec3 c, out vec3 along, out vec3 against) {
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    precise vec3 first = ab.yzx * ac.zxy;
    precise vec3 second = ab.zxy * ac.yzx;
    along = first;
    against = second;
}

// Whether a triangle has an area at all; one without is never hit.
bool triangle_has_area(vec3 a, vec3 b, vec3 c) {
    vec3 along;
    vec3 against;
    triangle_normal_terms(a, b, c, along, against);
    return any(notEqual(along, against));
}

// Where a ray meets a triangle's plane: t and a bound of its error, infinite where rounding decides or numbers are too
// small for one. `along`, `against`: of the normal; `p`: a corner relative to the origin; `d`: the direction; all with the
// axes in the same order. Of the axes the last one is added last, so that turning the others changes no bit.
//
// With N = |along| + |against| the normal is off by at most 4 u N in each component, its products with p and d by 8 u and
// 7 u of the sums below, and the quotient follows; 12 u covers the rounding of the sums.
void triangle_plane_distance(vec3 along, vec3 against, vec3 p, vec3 d, out float t, out float t_error) {
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
    bool holds = certain > 0.0 && height_reach > tiny * max(far, 1.0) && facing_reach > tiny * max(fast, 1.0);
    t = quotient;
    t_error = holds ? error : uintBitsToFloat(0x7F800000u);
}

// Tests a closed, two-sided triangle against a ray. On acceptance t is in units of |direction|,
// barycentrics are the weights of b and c, and t_error bounds the error of t. A ray in the plane of
// the triangle, or a triangle without area, is not hit.
bool triangle_intersect(vec3 origin, vec3 direction, vec3 a, vec3 b, vec3 c, out float t, out vec2 barycentrics,
    out float t_error) {
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
    // The ray passes at (0, 0). Beside a triangle that is small for its distance from there all products round to the
    // same, and edges alone would accept it. A triangle whose sheared corners hold (0, 0) stays.
    if (min(ax, min(bx, cx)) > 0.0 || max(ax, max(bx, cx)) < 0.0
        || min(ay, min(by, cy)) > 0.0 || max(ay, max(by, cy)) < 0.0) {
        return false;
    }
    precise float u0 = cx * by;
    precise float u1 = cy * bx;
    precise float v0 = ax * cy;
    precise float v1 = ay * cx;
    precise float w0 = bx * ay;
    precise float w1 = by * ax;
    bool front = u0 >= u1 && v0 >= v1 && w0 >= w1;
    bool back = u0 <= u1 && v0 <= v1 && w0 <= w1;
    if (!front && !back) {
        return false;
    }
    precise float u = u0 - u1;
    precise float v = v0 - v1;
    precise float w = w0 - w1;
    precise float det = u + v + w;
    if (det == 0.0) {
        return false;
    }
    // Rounding gives a triangle without area some.
    vec3 along;
    vec3 against;
    triangle_normal_terms(a, b, c, along, against);
    if (along == against) {
        return false;
    }
    precise float inverse = 1.0 / det;
    precise float az = pa.z / d.z;
    precise float bz = pb.z / d.z;
    precise float cz = pc.z / d.z;
    precise float scaled = u * az + v * bz + w * cz;
    barycentrics = vec2(v * inverse, w * inverse);
    // The exact value never leaves the corners' own range.
    float nearest = min(az, min(bz, cz));
    float farthest = max(az, max(bz, cz));
    float max_z = max(abs(az), max(abs(bz), abs(cz)));
    const float gamma2 = 1.1920930e-7;
    const float gamma3 = 1.7881396e-7;
    const float gamma8 = 4.7683738e-7;
    const float gamma9 = 5.3644210e-7;
    const float gamma12 = 7.1525625e-7;
    precise vec3 x = abs(vec3(ax, bx, cx));
    precise vec3 y = abs(vec3(ay, by, cy));
    // The shear adds rounding only as far as it moves a corner: a ray almost along the major axis moves none.
    precise vec3 shifted = gamma8 * abs(vec3(pa.z, pb.z, pc.z));
    precise vec3 dx = gamma3 * x + abs(sx) * shifted;
    precise vec3 dy = gamma3 * y + abs(sy) * shifted;
    precise float delta_u = gamma2 * (abs(u0) + abs(u1)) + ((x.z * dy.y + y.y * dx.z) + (y.z * dx.y + x.y * dy.z));
    precise float delta_v = gamma2 * (abs(v0) + abs(v1)) + ((x.x * dy.z + y.z * dx.x) + (y.x * dx.z + x.z * dy.x));
    precise float delta_w = gamma2 * (abs(w0) + abs(w1)) + ((x.y * dy.x + y.x * dx.y) + (y.y * dx.x + x.x * dy.y));
    precise float mixed_error = (delta_u * abs(az) + delta_v * abs(bz) + delta_w * abs(cz)
        + gamma9 * (abs(u * az) + abs(v * bz) + abs(w * cz))) * abs(inverse);
    // Corners are mixed well where they are about as far away as the ray's hit, and a plane is well known where its triangle
    // is not thin: whichever is known better. The bounds are as precise as what they decide about.
    float plane_t;
    float plane_error;
    triangle_plane_distance(triangle_permute(along, axis), triangle_permute(against, axis), pa, d, plane_t, plane_error);
    bool by_plane = plane_error < mixed_error;
    t = clamp(by_plane ? plane_t : scaled * inverse, nearest, farthest);
    // Both values lie within the corners' range, whose ends have six roundings each.
    t_error = min(by_plane ? plane_error : mixed_error, farthest - nearest + gamma12 * max_z);
    return true;
}

// Barycentrics of b and c of the point of the triangle's plane below `p`; they may lie outside [0, 1].
// Zero where the triangle has no area.
vec2 triangle_barycentrics(vec3 p, vec3 a, vec3 b, vec3 c) {
    vec3 ab = b - a;
    vec3 ac = c - a;
    vec3 normal = cross(ab, ac);
    float squared = dot(normal, normal);
    vec2 weights = vec2(dot(cross(p - a, ac), normal), dot(cross(ab, p - a), normal));
    return squared > 0.0 ? weights / squared : vec2(0.0);
}

// Where a ray meets the plane of a triangle: t, and the barycentrics of b and c there, which may lie
// outside [0, 1]. False where the ray runs in or parallel to the plane, or the triangle has no area.
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

// The point of a flat triangle's border that is nearest to a point.
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

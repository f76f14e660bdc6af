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

// Whether a triangle has an area at all; one without is never hit. Compared product by product, so that
// contraction cannot make a difference where there is none.
bool triangle_has_area(vec3 a, vec3 b, vec3 c) {
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    precise vec3 along = ab.yzx * ac.zxy;
    precise vec3 against = ab.zxy * ac.yzx;
    return any(notEqual(along, against));
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
    if (!triangle_has_area(a, b, c)) {
        return false;
    }
    precise float inverse = 1.0 / det;
    precise float az = pa.z / d.z;
    precise float bz = pb.z / d.z;
    precise float cz = pc.z / d.z;
    precise float scaled = u * az + v * bz + w * cz;
    t = scaled * inverse;
    barycentrics = vec2(v * inverse, w * inverse);
    // Rounding keeps t within the corners' own range, which the exact value never leaves.
    float nearest = min(az, min(bz, cz));
    float farthest = max(az, max(bz, cz));
    t = clamp(t, nearest, farthest);
    float max_z = max(abs(az), max(abs(bz), abs(cz)));
    const float gamma2 = 1.1920930e-7;
    const float gamma3 = 1.7881396e-7;
    const float gamma8 = 4.7683738e-7;
    const float gamma9 = 5.3644210e-7;
    const float gamma12 = 7.1525625e-7;
    vec3 x = abs(vec3(ax, bx, cx));
    vec3 y = abs(vec3(ay, by, cy));
    // The shear adds rounding only as far as it moves a corner: a ray almost along the major axis moves none.
    vec3 shifted = gamma8 * abs(vec3(pa.z, pb.z, pc.z));
    vec3 dx = gamma3 * x + abs(sx) * shifted;
    vec3 dy = gamma3 * y + abs(sy) * shifted;
    float delta_u = gamma2 * (abs(u0) + abs(u1)) + x.z * dy.y + y.y * dx.z + y.z * dx.y + x.y * dy.z;
    float delta_v = gamma2 * (abs(v0) + abs(v1)) + x.x * dy.z + y.z * dx.x + y.x * dx.z + x.z * dy.x;
    float delta_w = gamma2 * (abs(w0) + abs(w1)) + x.y * dy.x + y.x * dx.y + y.y * dx.x + x.x * dy.y;
    t_error = (delta_u * abs(az) + delta_v * abs(bz) + delta_w * abs(cz)
        + gamma9 * (abs(u * az) + abs(v * bz) + abs(w * cz))) * abs(inverse);
    // Both values lie within the corners' range, whose ends have six roundings each.
    t_error = min(t_error, farthest - nearest + gamma12 * max_z);
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

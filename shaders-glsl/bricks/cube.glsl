// The planes between the cells of a face of a cube, and where a ray intersects them. Columns and rows are
// pyramids with their apex at the centre; slices are parallel. For a view along an axis see
// ads/box_cells.glsl.
// Reads, writes: nothing.
// Nothing here is exact. With R the largest distance of the geometry and u = 2^-24, every position below is
// within 96 u R metres, and 32 u in x/z, of its exact value. Cells therefore list triangles within that
// distance.
#ifndef BRICKS_CUBE_GLSL
#define BRICKS_CUBE_GLSL

#include "bricks/slices.glsl"
#include "ads/views.glsl"

#define BRICKS_INFINITY uintBitsToFloat(0x7F800000u)

// A ray in the space of one face.
struct BricksRay {
    vec3 origin;          // metres from the centre
    vec3 direction;       // metres per unit of t
    // order in which cells are visited along each axis: 1 upwards, -1 downwards, 0 if x/z or y/z never
    // changes
    vec3 heading;
    vec2 still;           // x/z and y/z of the ray, used where the heading is 0
    float z_inverse;      // reciprocal of the direction's z; 0 if it is 0 or subnormal
};

// Transforms a ray into the space of a face. The given origin is relative to the centre, in the axes of the
// world.
BricksRay bricks_ray(vec3 origin, vec3 direction, uint face) {
    BricksRay ray;
    ray.origin = face_from_world(origin, face);
    ray.direction = face_from_world(direction, face);
    // Products are compared, so that two faces agree on the direction in which a ray crosses the seam between
    // them.
    precise vec2 ahead = ray.direction.xy * ray.origin.z;
    precise vec2 behind = ray.origin.xy * ray.direction.z;
    ray.heading = vec3(ahead.x > behind.x ? 1.0 : (ahead.x < behind.x ? -1.0 : 0.0),
        ahead.y > behind.y ? 1.0 : (ahead.y < behind.y ? -1.0 : 0.0), ray.direction.z >= 0.0 ? 1.0 : -1.0);
    bool moves = abs(ray.direction.z) >= 1.1754944e-38;
    ray.still = moves ? ray.direction.xy / ray.direction.z : ray.origin.xy / ray.origin.z;
    ray.z_inverse = moves ? 1.0 / ray.direction.z : 0.0;
    return ray;
}

// Returns the t at which the ray crosses the boundary x/z = c in the direction of the heading; infinity if it
// does not.
float bricks_crossing(float c, float o, float d, float oz, float dz, float heading) {
    float denominator = d - c * dz;
    return denominator * heading > 0.0 ? (c * oz - o) / denominator : BRICKS_INFINITY;
}

// Returns the t at which the ray intersects each of three planes: those below column planes.x, row planes.y
// and slice planes.z.
vec3 bricks_exits(BricksRay ray, ivec3 planes, float column, BricksSlices slices) {
    vec2 c = vec2(planes.xy) * column - 1.0;
    float tz = planes.z > 0 && planes.z < slices.count && ray.z_inverse != 0.0
        ? (bricks_slice_boundary(planes.z, slices) - ray.origin.z) * ray.z_inverse : BRICKS_INFINITY;
    return vec3(bricks_crossing(c.x, ray.origin.x, ray.direction.x, ray.origin.z, ray.direction.z, ray.heading.x),
        bricks_crossing(c.y, ray.origin.y, ray.direction.y, ray.origin.z, ray.direction.z, ray.heading.y), tz);
}

// Returns the cell that the ray is in at t. If rounding leaves the column or the row open, returns the one
// that the ray visits first: the ray crosses a boundary behind it at once, whereas it could not step back
// over a boundary that it never crosses.
ivec3 bricks_cell_at(BricksRay ray, float t, float half_side, float rounding, BricksSlices slices) {
    vec3 p = ray.origin + t * ray.direction;
    float inverse = 1.0 / max(p.z, 1.0e-37);
    vec2 place = p.xy * inverse - ray.heading.xy * (rounding * inverse + 1.0e-6);
    place = vec2(ray.heading.x == 0.0 ? ray.still.x : place.x, ray.heading.y == 0.0 ? ray.still.y : place.y);
    // The place is clamped before the conversion, since integers must be less than 2^31.
    vec2 cell = clamp(place * half_side + half_side, vec2(-1.0), vec2(2.0 * half_side));
    return ivec3(ivec2(floor(cell)), bricks_slice_of(p.z, slices));
}

// Returns the face beyond one side of a face: the side at the first or last column (`columns`) or row, lower
// or upper.
uint bricks_face_beyond(uint face, bool columns, bool lower) {
    uint axis = ((face >> 1) + (columns ? 1u : 2u)) % 3u;
    return 2u * axis + (lower ? 1u : 0u);
}

#endif

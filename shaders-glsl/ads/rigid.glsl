// The map of a part whose structure was built in a space of its own, and rays in that space.
// Reads: the map, which follows the runs in the buffer of the header of GEOMETRY_SET. Writes: nothing.
// Source: Bürger et al. section 1.2, cubes of rigid objects. An affine map keeps t along a ray if the
// direction is mapped without being normalised.
#ifndef ADS_RIGID_GLSL
#define ADS_RIGID_GLSL

#include "ads/constants.glsl"
#include "ads/geometry.glsl"

// The affine map from the pose of a part to the space in which its structure was built. Both are in metres.
// It takes a posed point p to x * d.x + y * d.y + z * d.z + offset, where d = p - centre. Shared, 72 bytes.
struct GeometryRigid {
    vec3 x;               // first column of the linear map
    vec3 y;               // second column
    vec3 z;               // third column
    vec3 centre;          // posed point from which the map is taken, the middle of the part
    vec3 offset;          // where the map takes `centre`
    float stretch;        // largest factor by which a length grows
    // bound of the distance of the part's corners from `centre`, in the space of the build, metres
    float reach;
    // bound of the shift of the part's corners by rounding, in the space of the build, metres; infinite if
    // there is no map
    float error;
};

// Largest shift of a ray by rounding, relative to the distance of its origin from the part: 32 units of
// rounding, for mapping the ray and for testing triangles.
#define RIGID_ROUNDING 0.0000019073486

// The buffer of the header as an array of maps. The map is the first element that lies behind the runs.
layout(set = GEOMETRY_SET, binding = 0, scalar) readonly buffer GeometryRigidBuffer {
    GeometryRigid geometry_rigids[];
};

GeometryRigid rigid_map() {
    uint end = GEOMETRY_HEADER_BYTES + GEOMETRY_RUN_BYTES * max(geometry_header.run_count, 1u);
    return geometry_rigids[(end + GEOMETRY_RIGID_BYTES - 1u) / GEOMETRY_RIGID_BYTES];
}

// Transforms a posed point into the space of the build.
vec3 rigid_point(GeometryRigid map, vec3 point) {
    vec3 from_centre = point - map.centre;
    return (map.x * from_centre.x + map.y * from_centre.y + map.z * from_centre.z) + map.offset;
}

// Transforms a posed ray into the space of the build. `spread` gets a bound of the error of the ray's
// position until it has left the part.
Ray rigid_ray(GeometryRigid map, Ray ray, out float spread) {
    vec3 away = abs(ray.origin - map.centre);
    ray.origin = rigid_point(map, ray.origin);
    ray.direction = map.x * ray.direction.x + map.y * ray.direction.y + map.z * ray.direction.z;
    spread = RIGID_ROUNDING * (map.stretch * (away.x + away.y + away.z) + map.reach);
    return ray;
}

#endif

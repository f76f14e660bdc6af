// Place of a part whose structure was built in a space of its own, and rays in that space.
// Reads: what follows the runs in the header of GEOMETRY_SET. Writes: nothing.
// Source: Bürger et al. section 1.2, cubes of rigid objects. An affine map keeps t along a ray whose direction keeps its
// length.
#ifndef ADS_RIGID_GLSL
#define ADS_RIGID_GLSL

#include "ads/constants.glsl"
#include "ads/geometry.glsl"

// The map from where a part is posed to where its structure was built, both in metres. Shared, 72 bytes.
struct GeometryRigid {
    vec3 x;               // first column of the linear map
    vec3 y;               // second column
    vec3 z;               // third column
    vec3 centre;          // of the space it was built in, as posed
    vec3 offset;          // where the map takes `centre`
    float stretch;        // no length grows by more than this
    float reach;          // a bound of how far its corners are from `centre`, where it was built
    float error;          // how far rounding may move its corners, where it was built; infinite where there is no map
};

// Largest shift of a ray by rounding, over its distance from the part: 32 units, for mapping the ray and
// testing triangles.
#define RIGID_ROUNDING 0.0000019073486

// Buffer of the header, in which the map is the first element behind the runs.
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

// Transforms a ray into the space of the build, and returns the largest error of its place until it has left
// the part.
Ray rigid_ray(GeometryRigid map, Ray ray, out float spread) {
    vec3 away = abs(ray.origin - map.centre);
    ray.origin = rigid_point(map, ray.origin);
    ray.direction = map.x * ray.direction.x + map.y * ray.direction.y + map.z * ray.direction.z;
    spread = RIGID_ROUNDING * (map.stretch * (away.x + away.y + away.z) + map.reach);
    return ray;
}

#endif

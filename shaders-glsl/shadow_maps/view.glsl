// Transforms points into views and onto their maps.
// Reads, writes: nothing.
#ifndef SHADOW_MAPS_VIEW_GLSL
#define SHADOW_MAPS_VIEW_GLSL

#include "shadow_maps/types.glsl"

// Transforms a point into the frame of a view. A corner that triangles share gets equal values in each of
// them, so that no gap opens between the triangles.
vec3 shadow_maps_in_view(ShadowMapsView view, vec3 p) {
    precise vec3 q = p - view.origin;
    precise float x = (view.right.x * q.x + view.right.y * q.y) + view.right.z * q.z;
    precise float y = (view.up.x * q.x + view.up.y * q.y) + view.up.z * q.z;
    precise float z = (view.forward.x * q.x + view.forward.y * q.y) + view.forward.z * q.z;
    return vec3(x, y, z);
}

// Finds the place on the map, from -1 to 1, of a point in the frame of a view. Returns false if the point is
// not on the map.
bool shadow_maps_on_map(ShadowMapsView view, vec3 p, out vec2 place) {
    place = view.parallel != 0u ? p.xy : p.xy / p.z;
    return (view.parallel != 0u || p.z > 0.0) && all(lessThanEqual(abs(place), vec2(1.0)));
}

#endif

// Finds the first hit of a camera ray without a trace: the nearest fragment in the cell of the camera's view
// that the ray passes.
// Reads: bounds, lists, nodes, data, with payload index geometry. Writes: header.corrupted.
// Source: MMRT section 3.4, whose paths begin at the first fragment of the camera's view.
#ifndef ABUFFER_FIRST_HIT_GLSL
#define ABUFFER_FIRST_HIT_GLSL

#include "ads/views.glsl"
#include "abuffer/candidates.glsl"
#include "abuffer/lists.glsl"

// Returns the cell of the camera's view through which a direction from the eye passes; `seen` is the
// direction in that view. If the direction passes through none, the result is a cell that the view does not
// have.
ivec2 abuffer_cell_seen(AbufferRef s, vec3 seen) {
    if (!(seen.z > 0.0)) {
        return ivec2(-2);
    }
    float side = float(abuffer_resolution(s, ABUFFER_CAMERA));
    return ivec2(floor(clamp(0.5 * (seen.xy / seen.z + 1.0) * side, -2.0, side + 2.0)));
}

// Finds the link of a cell's nearest fragment, leaving out those whose back the ray passes; the link is 0 if
// there is none. Returns false if the work budget ended before. Buckets follow one another in depth, so the
// first bucket with a fragment is enough; in a bucket, a list that is not sorted is read to its end.
bool abuffer_find_nearest(AbufferRef s, Ray ray, uint cell, out uint nearest) {
    bool ordered = ABUFFER_SORT != 0u && !ABUFFER_PAGED && ABUFFER_HEADER(s).unsorted == 0u;
    float nearest_z = 0.0;
    uint work = 0u;
    nearest = 0u;
    for (uint bucket = 0u; bucket < ABUFFER_BUCKETS && nearest == 0u; bucket++) {
        AbufferCursor cursor = abuffer_list_begin(s, abuffer_list(cell, bucket), false);
        while (cursor.link != 0u && !(ordered && nearest != 0u)) {
            if (work++ >= work_budget) {
                return false;
            }
            uint link = abuffer_list_next(s, cursor);
            if (link == 0u) {
                break;
            }
            float z = abuffer_z(s, link);
            uint primitive = ABUFFER_PAYLOAD == ABUFFER_PAYLOAD_INDEX ? abuffer_data(s, link, 0u) : PRIMITIVE_UNKNOWN;
            bool is_nearer = nearest == 0u || z < nearest_z
                || (z == nearest_z && abuffer_payload_is_lower(s, link, nearest));
            if (is_nearer && !abuffer_is_passed(s, ray, primitive, link)) {
                nearest = link;
                nearest_z = z;
            }
        }
    }
    return true;
}

// Returns the direction from the eye through the centre of a cell of the camera's view, with depth 1 in the
// view. The sum inverts the view's matrix, whose rows are perpendicular to one another.
vec3 abuffer_centre_of(AbufferRef s, ivec2 cell) {
    uint side = abuffer_resolution(s, ABUFFER_CAMERA);
    vec3 x = ABUFFER_HEADER(s).camera_x;
    vec3 y = ABUFFER_HEADER(s).camera_y;
    vec3 z = ABUFFER_HEADER(s).camera_z;
    return cell_center(cell.x, side) / dot(x, x) * x + cell_center(cell.y, side) / dot(y, y) * y + z / dot(z, z);
}

// Returns the hit on a fragment of a cell. The hit's t is where the ray has the fragment's depth, and its
// surface is that at the cell's centre.
Hit abuffer_hit_on(AbufferRef s, uint link, ivec2 cell, float depth_of_direction) {
    float z = abuffer_z(s, link);
    float t = z / depth_of_direction;
    if (ABUFFER_PAYLOAD != ABUFFER_PAYLOAD_INDEX) {
        return Hit(t, PRIMITIVE_UNKNOWN, uintBitsToFloat(link), 0.0);
    }
    uint primitive = abuffer_data(s, link, 0u);
    vec2 found = plane_barycentrics(primitive, abuffer_eye(s) + z * abuffer_centre_of(s, cell));
    found = max(found, 0.0);
    found /= max(found.x + found.y, 1.0);
    return Hit(t, primitive, found.x, found.y);
}

// Finds the first hit of a camera ray, which begins at the eye. Returns TRACE_PAUSED if the work budget ended
// before.
uint abuffer_first_hit(AbufferRef s, Ray ray, out Hit hit) {
    hit = Hit(ray.t_max, PRIMITIVE_NONE, 0.0, 0.0);
    if (!ray_is_valid(ray)) {
        return TRACE_MISS;
    }
    if (!geometry_is_built(abuffer_status(s))) {
        return TRACE_NOT_READY;
    }
    vec3 seen = abuffer_view_from_world(s, ray.direction, ABUFFER_CAMERA);
    ivec2 place = abuffer_cell_seen(s, seen);
    uint cell = abuffer_cell(s, ABUFFER_CAMERA, place);
    if (cell >= abuffer_cell_count(s)) {
        return TRACE_MISS;
    }
    uint nearest;
    if (!abuffer_find_nearest(s, ray, cell, nearest)) {
        return TRACE_PAUSED;
    }
    if (nearest == 0u) {
        return TRACE_MISS;
    }
    hit = abuffer_hit(s, abuffer_hit_on(s, nearest, place, seen.z));
    return TRACE_HIT;
}

#endif

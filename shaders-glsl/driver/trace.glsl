// Asks the driver for the boxes that a ray passes through, and tests their triangles.
// Reads: header, the driver's tree, geometry. Writes: nothing.
// Source: VK_KHR_ray_query; docs/systems/driver-rt.md. The test of triangles is the project's, so hits do not
// depend on the driver.
// Words of the cursor, used by rays that test all triangles: 0 flags; 1 the place among all triangles.
#ifndef DRIVER_TRACE_GLSL
#define DRIVER_TRACE_GLSL

#include "contract/bits.glsl"
#include "contract/trace_functions.glsl"
#include "ads/bounds_interval.glsl"
#include "ads/constants.glsl"
#include "ads/evaluate.glsl"
#include "ads/march_cube.glsl"
#include "driver/header.glsl"

#define ListedRef DriverRef
#include "ads/listed.glsl"

#define DRIVER_CURSOR_STARTED 0, 1

#define DRIVER_SMALLEST_NORMAL 1.1754944e-38

// Tests the triangles of all boxes that the ray passes through within the interval `clip` of t. The driver
// works in units of the header's scale, with a direction whose largest component is from 1 to 2.
void driver_trace_boxes(DriverRef s, Ray ray, vec3 origin, vec2 clip, float slack, bool any_hit, inout TraceState state) {
    float scale = DRIVER_HEADER(s).scale;
    float size = largest_coordinate(ray.direction);
    float longer = uintBitsToFloat(floatBitsToUint(size) >> 23 << 23);
    vec3 direction = ray.direction * driver_scale_of(size);
    vec2 range = clamp(clip * longer * scale, vec2(0.0), vec2(1.0e30));
    uint count = geometry_triangle_count();
    trace_log_view(0u, clip.x, clip.y);
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(DRIVER_HEADER(s).tree), gl_RayFlagsNoneEXT, 0xFFu, origin * scale,
        range.x, direction, range.y);
    float end = range.y;
    bool open = true;
    // There are two loops, since software drivers end a loop after 65,535 iterations.
    while (open) {
        for (uint turn = 0u; open && turn < work_budget; turn++) {
            open = rayQueryProceedEXT(query);
            if (!open) {
                break;
            }
            uint primitive = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
            state.entries++;
            trace_log_visit(STEP_ENTRY, primitive, 0u, 0u, 0.0, 0.0);
            // Boxes beyond the number of triangles belong to no triangle.
            if (primitive < count && test_anywhere(ray, primitive, state)) {
                // Ends the query at the best hit, so that boxes behind it are not visited.
                float best = (state.best.t + slack) * longer * scale;
                if (any_hit) {
                    open = false;
                } else if (best < end) {
                    end = max(best, range.x);
                    rayQueryGenerateIntersectionEXT(query, end);
                }
            }
        }
    }
    rayQueryTerminateEXT(query);
}

// Traces a ray. Only rays that test all triangles can pause.
uint driver_trace(DriverRef s, Ray ray, inout TraceState state, bool any_hit) {
    vec3 origin = ray.origin - DRIVER_HEADER(s).centre;
    float reach = DRIVER_HEADER(s).reach;
    float slack = hit_slack(origin, ray.direction, reach);
    vec2 clip = bounds_interval(DRIVER_HEADER(s).lower, DRIVER_HEADER(s).upper, origin, ray.direction, ray.t_min - slack,
        ray.t_max + slack);
    if (!(clip.x < clip.y)) {
        trace_log(STEP_SKIP, SKIP_BOUNDS, 0u, 0u, ray.t_min, ray.t_max);
        return TRACE_MISS;
    }
    // Beyond this distance rounding exceeds the margins of the boxes. Directions of subnormal numbers have no
    // scale.
    bool is_near = largest_coordinate(origin) <= ORIGIN_LIMIT * reach;
    if (is_near && largest_coordinate(ray.direction) >= DRIVER_SMALLEST_NORMAL) {
        driver_trace_boxes(s, ray, origin, clip, slack, any_hit, state);
        return state.best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
    }
    uint work = 0u;
    uint place = state.cursor[1];
    if (state.cursor[0] == 0u) {
        trace_log_view(VIEW_ALL, clip.x, clip.y);
    }
    if (listed_test(s, ray, true, any_hit, place, state, work)) {
        state.cursor[0] = bits_put(true, DRIVER_CURSOR_STARTED);
        state.cursor[1] = place;
        return TRACE_PAUSED;
    }
    return state.best.primitive == PRIMITIVE_NONE ? TRACE_MISS : TRACE_HIT;
}

uint driver_status(DriverRef s) {
    return DRIVER_HEADER(s).status;
}

Hit driver_hit(DriverRef s, Hit best) {
    return best;
}

TRACE_FUNCTIONS(DriverRef, driver)

#endif

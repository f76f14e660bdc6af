// Chooses directions by the lights, and gives the density with which the lights would choose a direction.
// Reads: frame, lights, emissive triangles, geometry, materials, textures, environment. Writes: nothing.
// Source: docs/shading.md, "Lights"; KHR_lights_punctual for range and cone.
#ifndef SCENE_LIGHT_GLSL
#define SCENE_LIGHT_GLSL

#include "scene/emission.glsl"
#include "scene/environment.glsl"
#include "scene/spawn.glsl"

#define LIGHT_INFINITY uintBitsToFloat(0x7F800000u)

LightSample light_sample_none() {
    return LightSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0u, 0u);
}

// Returns the first light without extent whose cumulative share exceeds `random`.
uint light_search_punctual(uint count, float random) {
    uint low = 0u;
    uint high = count - 1u;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (scene_light_cumulative(middle) > random) high = middle;
        else low = middle + 1u;
    }
    return low;
}

// Returns the share of its light that a light with a range still sends at a distance, beside the inverse
// square.
float light_window(float distance, float range) {
    float ratio = distance / range;
    return clamp(1.0 - ratio * ratio * ratio * ratio, 0.0, 1.0);
}

// Chooses a light without extent by its share of their power.
LightSample light_sample_punctual(Frame frame, vec3 from, float pick) {
    LightSample chosen = light_sample_none();
    uint index = light_search_punctual(frame.light_count, pick);
    Light light = scene_light(index);
    chosen.pdf = index == 0u ? light.cumulative : light.cumulative - scene_light_cumulative(index - 1u);
    if (!(chosen.pdf > 0.0)) return chosen;
    chosen.flags = SAMPLE_VALID | SAMPLE_DELTA;
    chosen.ray_flags = (index + 1u) << RAY_LIGHT_SHIFT;
    if (light.kind == LIGHT_DIRECTIONAL) {
        chosen.direction = -light.direction;
        chosen.distance = LIGHT_INFINITY;
        chosen.radiance = light.intensity;
        return chosen;
    }
    vec3 towards = light.position - from;
    float squared = dot(towards, towards);
    if (!(squared > 0.0)) return light_sample_none();
    chosen.distance = sqrt(squared);
    chosen.direction = towards / chosen.distance;
    chosen.target = light.position;
    float window = light_window(chosen.distance, light.range);
    if (light.kind == LIGHT_SPOT) {
        float cone = clamp(dot(light.direction, -chosen.direction) * light.cone_scale + light.cone_offset, 0.0, 1.0);
        window *= cone * cone;
    }
    chosen.radiance = light.intensity * (window / squared);
    return chosen;
}

// Returns the first emissive triangle whose cumulative share exceeds `random`.
uint light_search_emissive(uint count, float random) {
    uint low = 0u;
    uint high = count - 1u;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (scene_emissive_cumulative(middle) > random) high = middle;
        else low = middle + 1u;
    }
    return low;
}

// Returns the share of an emissive triangle in the power of all.
float light_emissive_share(uint entry) {
    float above = scene_emissive_cumulative(entry);
    return entry == 0u ? above : above - scene_emissive_cumulative(entry - 1u);
}

// Returns the density, 1/sr, of a point that is uniform on a triangle, seen along the unit `direction` from
// `distance` metres away; 0 if the triangle is seen edge-on.
float light_area_pdf(vec3 normal, float twice_area, vec3 direction, float distance) {
    float projected = 0.5 * twice_area * abs(dot(normal, direction));
    return projected > 0.0 ? distance * distance / projected : 0.0;
}

// Chooses an emissive triangle by its share of their power, and a point that is uniform on the triangle.
LightSample light_sample_emissive(Frame frame, vec3 from, float pick, vec2 place) {
    LightSample chosen = light_sample_none();
    uint entry = light_search_emissive(frame.emissive_count, pick);
    uint primitive = scene_emissive_triangle(entry).primitive;
    float root = sqrt(place.x);
    vec2 barycentrics = vec2(root * (1.0 - place.y), root * place.y);
    vec3 weights = barycentric_weights(barycentrics);
    vec3 a, b, c;
    geometry_vertices(primitive, a, b, c);
    float error;
    vec3 position = triangle_point(weights, a, b, c, error);

    vec3 towards = position - from;
    float squared = dot(towards, towards);
    if (!(squared > 0.0)) return chosen;
    chosen.distance = sqrt(squared);
    chosen.direction = towards / chosen.distance;
    float twice_area;
    vec3 normal = triangle_normal(b - a, c - a, twice_area);
    float density = light_area_pdf(normal, twice_area, chosen.direction, chosen.distance);
    chosen.pdf = light_emissive_share(entry) * density;
    if (!(chosen.pdf > 0.0)) return light_sample_none();

    bool counter_clockwise = dot(normal, chosen.direction) < 0.0;
    DrawShading draw = scene_draw_shading(scene_draw_of(primitive));
    bool mirrored = (draw.flags & DRAW_MIRRORED) != 0u;
    chosen.radiance = emission_at(draw, primitive, barycentrics, counter_clockwise != mirrored);
    chosen.target = spawn_position(position, error, normal, -chosen.direction);
    chosen.flags = SAMPLE_VALID;
    chosen.ray_flags = min(frame.light_count + entry + 1u, RAY_LIGHT_MOST) << RAY_LIGHT_SHIFT;
    return chosen;
}

// Chooses a direction from the surface to a light. The random numbers are for the kind of light, for the
// light or the row of the environment, and two for the place.
LightSample light_sample(Surface s, vec4 random) {
    Frame frame = scene_frame();
    vec3 shares = frame.kind_shares;
    LightSample chosen = light_sample_none();
    float share;
    if (SHADING_LIGHTS && random.x < shares.x) {
        share = shares.x;
        chosen = light_sample_punctual(frame, s.position, random.y);
    } else if (SHADING_EMITTERS && random.x < shares.x + shares.y) {
        share = shares.y;
        chosen = light_sample_emissive(frame, s.position, random.y, random.zw);
    } else {
        share = shares.z;
        if (!(share > 0.0)) return chosen;
        chosen.direction = environment_sample(random.y, random.zw, chosen.radiance, chosen.pdf);
        chosen.distance = LIGHT_INFINITY;
        chosen.flags = chosen.pdf > 0.0 ? SAMPLE_VALID : 0u;
    }
    chosen.pdf *= share;
    return chosen;
}

// Returns the shadow ray that tests whether the sample is visible from the surface.
Ray light_shadow_ray(Surface s, LightSample chosen) {
    Ray ray;
    if (chosen.distance < LIGHT_INFINITY) ray = spawn_segment(s, chosen.target);
    else ray = spawn_ray(s, chosen.direction, LIGHT_INFINITY);
    ray.flags |= chosen.ray_flags;
    return ray;
}

// Returns the density, 1/sr, with which light_sample chooses `position` on triangle `primitive` from
// `origin`; 0 if it never does.
float light_pdf_emitter(uint primitive, vec3 origin, vec3 position) {
    Frame frame = scene_frame();
    if (!SHADING_EMITTERS || frame.emissive_count == 0u || primitive == PRIMITIVE_NONE) return 0.0;
    DrawShading draw = scene_draw_shading(scene_draw_of(primitive));
    if (draw.first_emissive == EMISSIVE_NONE) return 0.0;
    vec3 a, b, c;
    geometry_vertices(primitive, a, b, c);
    vec3 towards = position - origin;
    float distance = length(towards);
    if (!(distance > 0.0)) return 0.0;
    float twice_area;
    vec3 normal = triangle_normal(b - a, c - a, twice_area);
    float density = light_area_pdf(normal, twice_area, towards / distance, distance);
    uint entry = draw.first_emissive + primitive - draw.first_triangle;
    return light_emissive_share(entry) * density * frame.kind_shares.y;
}

// Returns the density, 1/sr, with which light_sample chooses `direction` by the environment.
float environment_pdf(vec3 direction) {
    Frame frame = scene_frame();
    if (frame.environment_sampled == 0u) return 0.0;
    return environment_pdf_alone(direction) * frame.kind_shares.z;
}

#endif

// Chooses a light, and a ray with its flux that leaves the light; computes the sizes of the photon map.
// Reads: frame, lights, emissive triangles, environment, geometry, materials, textures. Writes: nothing.
// Source: docs/photons.md, "Emission"; Jensen 2001, section 5.2.
#ifndef INTEGRATORS_PHOTON_EMISSION_GLSL
#define INTEGRATORS_PHOTON_EMISSION_GLSL

#include "integrators/photons.glsl"
#include "scene/light.glsl"

// Ratio of the radius of the disk from which distant light is emitted to the radius that covers all
// triangles, for rounding.
#define PHOTON_DISK_MARGIN 1.001

// A photon as it leaves a light.
struct Emission {
    Ray ray;                  // inactive if nothing is emitted
    vec3 flux;                // W, divided by the probability with which the photon was chosen
    float range;              // metres up to which a light without extent shines
};

Emission emission_none() {
    return Emission(ray_inactive(), vec3(0.0), LIGHT_INFINITY);
}

// Returns a ray of unlimited length that leaves a light.
Ray emission_ray(vec3 origin, vec3 direction, uint primitive) {
    return Ray(origin, 0.0, direction, LIGHT_INFINITY, primitive, scene_frame().spawned_ray_flags, 0.0, 0.0);
}

// Emits from a disk that is perpendicular to the direction, covers all triangles, and lies before all of
// them.
Emission emission_from_afar(vec3 direction, vec3 irradiance, vec2 random) {
    vec3 centre = 0.5 * (geometry_header.lower + geometry_header.upper);
    float radius = 0.5 * length(geometry_header.upper - geometry_header.lower) * PHOTON_DISK_MARGIN;
    float away = radius * sqrt(random.x);
    float turn = 2.0 * MICROFACET_PI * random.y;
    vec3 origin = centre + basis_around(direction) * vec3(away * cos(turn), away * sin(turn), -radius);
    Ray ray = emission_ray(origin, direction, PRIMITIVE_NONE);
    return Emission(ray, irradiance * (MICROFACET_PI * radius * radius), LIGHT_INFINITY);
}

// Emits from a light without extent, which `pick` chooses.
Emission emission_punctual(Frame frame, float pick, vec2 random) {
    uint index = light_search_punctual(frame.light_count, pick);
    Light light = scene_light(index);
    float share = index == 0u ? light.cumulative : light.cumulative - scene_light_cumulative(index - 1u);
    if (!(share > 0.0)) return emission_none();
    Emission emission;
    if (light.kind == LIGHT_DIRECTIONAL) {
        emission = emission_from_afar(light.direction, light.intensity, random);
    } else {
        // The direction is uniform over the cone around a spot's direction, or over the sphere.
        bool spot = light.kind == LIGHT_SPOT;
        float least = spot ? max(-light.cone_offset / light.cone_scale, -1.0) : -1.0;
        float cosine = 1.0 - random.x * (1.0 - least);
        float sine = sqrt(max(0.0, 1.0 - cosine * cosine));
        float turn = 2.0 * MICROFACET_PI * random.y;
        vec3 axis = spot ? light.direction : vec3(0.0, 0.0, 1.0);
        vec3 direction = basis_around(axis) * vec3(sine * cos(turn), sine * sin(turn), cosine);
        float inside = spot ? clamp(cosine * light.cone_scale + light.cone_offset, 0.0, 1.0) : 1.0;
        vec3 flux = light.intensity * (inside * inside * 2.0 * MICROFACET_PI * (1.0 - least));
        emission = Emission(emission_ray(light.position, direction, PRIMITIVE_NONE), flux, light.range);
    }
    emission.flux /= share;
    return emission;
}

// Emits from an emissive triangle, which `pick` chooses, at a place on it. `random` has one number for the
// side, and two for the direction.
Emission emission_emissive(Frame frame, float pick, vec2 place, vec3 random) {
    uint entry = light_search_emissive(frame.emissive_count, pick);
    float share = light_emissive_share(entry);
    if (!(share > 0.0)) return emission_none();
    uint primitive = scene_emissive_triangle(entry).primitive;
    float root = sqrt(place.x);
    vec2 barycentrics = vec2(root * (1.0 - place.y), root * place.y);
    vec3 a, b, c;
    geometry_vertices(primitive, a, b, c);
    float error;
    vec3 position = triangle_point(barycentric_weights(barycentrics), a, b, c, error);
    float twice_area;
    vec3 normal = triangle_normal(b - a, c - a, twice_area);
    DrawShading draw = scene_draw_shading(scene_draw_of(primitive));
    bool both = (scene_material(draw.material).flags & MATERIAL_DOUBLE_SIDED) != 0u;
    bool front = !both || random.x < 0.5;
    if (front == ((draw.flags & DRAW_MIRRORED) != 0u)) normal = -normal;
    vec3 radiance = emission_at(draw, primitive, barycentrics, front);
    vec3 direction = normalize(basis_around(normal) * cosine_hemisphere(random.yz));
    vec3 origin = spawn_position(position, error, normal, direction);
    float area = (both ? 2.0 : 1.0) * 0.5 * twice_area;
    return Emission(emission_ray(origin, direction, primitive), radiance * (MICROFACET_PI * area / share), LIGHT_INFINITY);
}

// Chooses a light, and a photon that leaves it. `place` has numbers for the kind of light, for the light and
// for a place; `towards` has numbers for the direction.
Emission emission_sample(vec4 place, vec4 towards) {
    Frame frame = scene_frame();
    vec3 shares = frame.kind_shares;
    Emission emission = emission_none();
    // Without triangles there are no bounds.
    if (frame.triangle_count == 0u) return emission;
    float share;
    if (SHADING_LIGHTS && place.x < shares.x) {
        share = shares.x;
        emission = emission_punctual(frame, place.y, towards.zw);
    } else if (SHADING_EMITTERS && place.x < shares.x + shares.y) {
        share = shares.y;
        emission = emission_emissive(frame, place.y, place.zw, towards.xzw);
    } else {
        share = shares.z;
        if (!(share > 0.0)) return emission;
        vec3 radiance;
        float pdf;
        vec3 direction = -environment_sample(place.y, place.zw, radiance, pdf);
        if (!(pdf > 0.0)) return emission;
        emission = emission_from_afar(direction, radiance / pdf, towards.zw);
    }
    emission.flux /= share;
    return emission;
}

// Returns the radius within which photons are gathered, and the side of a cell of the map, both in metres.
vec2 sizes_of_map() {
    vec3 lower = geometry_header.lower;
    vec3 upper = geometry_header.upper;
    float radius = wave.number;
    if ((wave.marks & PHOTON_RADIUS_IS_SHARE) != 0u) radius *= length(upper - lower);
    vec3 farthest = max(abs(lower), abs(upper));
    // The radius is positive even if the geometry has no extent, in which case nothing is lit.
    radius = max(radius, 1.0e-15);
    return vec2(radius, max(2.0 * radius, largest_component(farthest) / PHOTON_GRID_MOST));
}

#endif

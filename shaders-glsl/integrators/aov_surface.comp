// Records the hit of every slot in terms of materials and meshes, for the pixel.
// Reads: surfaces of the queue, geometry, draws, materials, vertex attributes. Writes: surface pixels. One
// invocation per slot of the domain.
// Source: docs/images.md, "Further images".
#version 460
#include "contract/extensions.glsl"
#include "ads/geometry.glsl"
#include "ads/queue.glsl"
#include "integrators/storage.glsl"
#include "scene/attributes.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

// Hit of the ray through a pixel's centre, in terms of materials and meshes. Shared, 48 bytes.
struct AovSurface {
    vec3 albedo;          // base colour, linear; of an unlit material the colour it shows; 0 without a hit
    vec3 position;        // metres relative to the frame origin; 0 without a hit
    vec2 uv;              // texture coordinates 0; 0 if the mesh has none or the triangle is not known
    vec2 weights;         // weights of vertices 1 and 2 of the triangle; 0 if the triangle is not known
    uint material;        // index of the material, or PRIMITIVE_NONE
    uint instance;        // index of the instance, or PRIMITIVE_NONE
};

layout(set = INTEGRATOR_SET, binding = 9, scalar) writeonly buffer AovSurfaceBuffer { AovSurface aov_surfaces[]; };

// Returns the weights of vertices 1 and 2 at a point of the triangle with these corners; 0 if the triangle
// has no area.
vec2 weights_at(vec3 point, vec3 a, vec3 b, vec3 c) {
    vec3 ab = b - a;
    vec3 ac = c - a;
    vec3 normal = cross(ab, ac);
    float squared = dot(normal, normal);
    if (!(squared > 0.0)) return vec2(0.0);
    vec3 along = point - a;
    return vec2(dot(cross(along, ac), normal), dot(cross(ab, along), normal)) / squared;
}

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    AovSurface met = AovSurface(vec3(0.0), vec3(0.0), vec2(0.0), vec2(0.0), PRIMITIVE_NONE, PRIMITIVE_NONE);
    Surface surface = queue_surface(slot);
    if ((surface.valid & SURFACE_POSITION) != 0u) {
        met.position = surface.position;
    }
    if ((surface.valid & SURFACE_MATERIAL) != 0u && surface.material != MATERIAL_NONE) {
        met.material = surface.material;
        bool unlit = (scene_material(surface.material).flags & MATERIAL_UNLIT) != 0u;
        met.albedo = unlit ? clamp(surface.emission, 0.0, 1.0) : surface.base_color;
    }
    if (surface.valid != 0u && surface.primitive < geometry_header.triangle_count) {
        DrawShading draw = scene_draw_shading(scene_draw_of(surface.primitive));
        met.instance = draw.instance;
        uvec3 triangle = geometry_triangle(surface.primitive);
        vec3 a, b, c;
        geometry_corners(triangle, a, b, c);
        met.weights = weights_at(surface.position, a, b, c);
        met.uv = attribute_uv(draw, 0u, triangle, barycentric_weights(met.weights));
    }
    aov_surfaces[band_place(wave_pixel(slot))] = met;
}

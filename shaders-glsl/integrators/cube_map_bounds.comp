// Finds the bounds of all triangles whose material is perfectly smooth.
// Reads: geometry, materials. Writes: keys in the header of the cube map, which begin with all bits set
// (lower corner) and with no bit set (upper corner).
// One invocation per slot of the domain; it looks at every pixel_count-th triangle.
// Source: docs/cube-map.md.
#version 460
#include "contract/extensions.glsl"
#define CUBE_MAP_HEADER_WRITTEN
#include "ads/geometry.glsl"
#include "ads/queue.glsl"
#include "integrators/cube_map.glsl"
#include "integrators/mirror_roughness.glsl"

layout(local_size_x = QUEUE_GROUP_SIZE) in;

bool is_smooth(uint primitive) {
    Material material = scene_material(scene_draw_shading(scene_draw_of(primitive)).material);
    return mirror_is_smooth(material.roughness) && (material.flags & MATERIAL_UNLIT) == 0u;
}

void main() {
    uint slot;
    if (!wave_slot(slot)) {
        return;
    }
    float infinity = uintBitsToFloat(0x7F800000u);
    vec3 lower = vec3(infinity);
    vec3 upper = vec3(-infinity);
    for (uint primitive = slot; primitive < geometry_triangle_count(); primitive += wave.pixel_count) {
        if (is_smooth(primitive)) {
            vec3 a, b, c;
            geometry_vertices(primitive, a, b, c);
            lower = min(lower, min(a, min(b, c)));
            upper = max(upper, max(a, max(b, c)));
        }
    }
    if (lower.x <= upper.x) {
        [[unroll]] for (int axis = 0; axis < 3; axis++) {
            atomicMin(cube_map_header.lower_keys[axis], key_of(lower[axis]));
            atomicMax(cube_map_header.upper_keys[axis], key_of(upper[axis]));
        }
    }
}

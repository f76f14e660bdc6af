// The Morton code of the middle of every triangle's box, 10 bits per axis; and the number of triangles, which
// only the device may know, with the root over them.
// Reads: geometry, header. Writes: scratch (keys), header.
// Source: Lauterbach et al. 2009.
#version 460
#include "contract/extensions.glsl"
#include "ads/placement.glsl"
#include "bvh/build.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

// Returns the number of cells of the grid per metre, equal along all axes, so that cells are cubes. It is
// kept a normal number: points outside the grid are clamped to it, which costs quality but no hit.
float cells_per_metre() {
    float extent = largest_axis(BVH_HEADER(build.structure).upper - BVH_HEADER(build.structure).lower);
    return clamp(BVH_CODE_CELLS / max(extent, 1.1754944e-38), 1.1754944e-38, PLACEMENT_LONGEST);
}

// Spreads 10 bits so that two zeros follow each.
uint spread(uint bits) {
    bits = (bits | (bits << 16u)) & 0x030000FFu;
    bits = (bits | (bits << 8u)) & 0x0300F00Fu;
    bits = (bits | (bits << 4u)) & 0x030C30C3u;
    return (bits | (bits << 2u)) & 0x09249249u;
}

void main() {
    uint primitive = build_invocation();
    uint triangles = geometry_triangle_count();
    if (primitive == 0u) {
        BVH_HEADER(build.structure).triangle_count = triangles;
        BVH_HEADER(build.structure).root = triangles > 1u ? 0u : (triangles == 1u ? BVH_LEAF : BVH_NONE);
    }
    if (primitive >= triangles) {
        return;
    }
    vec3 lower;
    vec3 upper;
    bvh_triangle_box(primitive, lower, upper);
    vec3 middle = 0.5 * lower + 0.5 * upper - BVH_HEADER(build.structure).lower;
    vec3 cells = clamp(middle * cells_per_metre(), vec3(0.0), vec3(BVH_CODE_CELLS - 1.0));
    uvec3 cell = uvec3(cells);
    uint code = spread(cell.x) | (spread(cell.y) << 1u) | (spread(cell.z) << 2u);
    // The first buffer of keys begins at word 0, whatever the number of triangles.
    bvh_set_scratch(build.structure, 2u * primitive, code);
    bvh_set_scratch(build.structure, 2u * primitive + 1u, primitive);
}

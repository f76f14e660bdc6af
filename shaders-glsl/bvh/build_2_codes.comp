// Computes the Morton code of the middle of every triangle's box, with 10 bits per axis. Also stores the
// number of triangles, which only the device may know, and the root of a tree over so many.
// Reads: geometry, header. Writes: scratch (keys), header.triangle_count, header.root.
// One invocation per triangle.
// Source: Lauterbach et al. 2009.
#version 460
#include "contract/extensions.glsl"
#include "ads/placement.glsl"
#include "bvh/build.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

// Returns the number of cells per metre, equal along all axes, so that cells are cubes. The number is clamped
// to normal floats. Points outside the cells are clamped to them, which costs quality of the tree but no hit.
float cells_per_metre() {
    float extent = largest_axis(BVH_HEADER(build.structure).upper - BVH_HEADER(build.structure).lower);
    return clamp(BVH_CODE_CELLS / max(extent, 1.1754944e-38), 1.1754944e-38, PLACEMENT_LONGEST);
}

// Spreads 10 bits so that two zeros follow each bit.
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
    // The first buffer of keys begins at word 0 for any number of triangles.
    bvh_set_scratch(build.structure, 2u * primitive, code);
    bvh_set_scratch(build.structure, 2u * primitive + 1u, primitive);
}

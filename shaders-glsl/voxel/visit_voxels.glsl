// Marks the voxels of a column that a triangle reaches into, with the axis it faces most, or adds its
// normal or a vote for that axis to them. The same for every builder.
// Reads: geometry, header. Writes: voxels, normals, lists (voxels as leaves).
// Source: Frid Kastrati and Goswami section 3.2, voxel generation. Sums of whole numbers replace the moving average
// under a spin lock.
#ifndef VOXEL_VISIT_VOXELS_GLSL
#define VOXEL_VISIT_VOXELS_GLSL

#include "voxel/covered.glsl"
#include "voxel/column.glsl"

void voxel_visit_voxels(uint primitive, uint axis, ivec2 column) {
    AxisView view = voxel_column_view(build.structure, axis);
    int grid = int(view.resolution);
    vec3 a;
    vec3 b;
    vec3 c;
    voxel_view_vertices(view, primitive, a, b, c);
    ivec2 range;
    if (any(lessThan(column, ivec2(0))) || any(greaterThanEqual(column, ivec2(grid)))
        || !voxel_column_range(view, a, b, c, column, range)) {
        return;
    }
    // If all views keep all triangles, fragments decide a voxel's axis: compared with each of their normals,
    // a triangle weighs one step of VOXEL_NORMAL_STEPS along the axis it faces most, which decides only
    // without fragments.
    vec3 vote = vec3(0.0, 0.0, 1.0 / VOXEL_NORMAL_STEPS);
    vec3 normal = axis_to_world(VOXEL_AXES == VOXEL_AXES_ALL ? vote : voxel_unit_normal(a, b, c), axis);
    for (int depth = range.x; depth <= range.y; depth++) {
        uint index = voxel_index(build.structure, axis_to_world(ivec3(column, depth), axis));
        if (VOXEL_AXES == VOXEL_AXES_TRIANGLE) {
            voxel_mark(build.structure, index, VOXEL_OCCUPIED | 1u << axis);
            if (VOXEL_LEAVES == VOXEL_LEAVES_VOXELS) {
                voxel_hold_triangle(build.structure, index, primitive);
            }
        } else {
            voxel_mark(build.structure, index, VOXEL_OCCUPIED);
            voxel_add_normal(build.structure, index, normal);
        }
    }
}

#endif

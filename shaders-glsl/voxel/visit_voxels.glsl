// Marks the voxels of a column that a triangle reaches into, the same for every builder: with the axis that
// the triangle faces most, or by adding to their sums of normals the triangle's normal or a vote for that
// axis.
// Reads: geometry, header. Writes: voxels, normals, lists (if voxels are the leaves).
// Source: Frid Kastrati and Goswami section 3.2, voxel generation. Sums of whole numbers replace the moving
// average under a spin lock.
#ifndef VOXEL_VISIT_VOXELS_GLSL
#define VOXEL_VISIT_VOXELS_GLSL

#include "voxel/covered.glsl"
#include "voxel/column.glsl"

// Visits a column of voxels for a triangle; `axis` is the axis that the triangle faces most.
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
    // If every view keeps every triangle, fragments decide a voxel's axis. A triangle then adds only one step
    // of VOXEL_NORMAL_STEPS along the axis that it faces most, against the whole normal that each fragment
    // adds. So it decides only in voxels without fragments.
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

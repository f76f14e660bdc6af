// Describes the views of an A-buffer and their cells: the faces of a cube around the eye, the camera's view
// from the eye, or both.
// Reads: header. Writes: nothing.
// Source: MMRT section 3.1. Every face is a pyramid |x| <= z, |y| <= z with a border of one cell. The
// camera's view is the middle part of such a pyramid, with its full width or its full height. Turning a point
// into the camera's view rounds, turning a point into a face does not.
#ifndef ABUFFER_VIEWS_GLSL
#define ABUFFER_VIEWS_GLSL

#include "abuffer/header.glsl"
#include "ads/views.glsl"

// Returns the columns and rows of the camera's view without the border. Both are even, or both are odd.
ivec2 abuffer_camera_cells(AbufferRef s) {
    uint cells = ABUFFER_HEADER(s).camera_cells;
    return ivec2(cells & 0xFFFFu, cells >> 16);
}

// Returns the number of cells along a side of the square that contains a view, without the border.
uint abuffer_resolution(AbufferRef s, uint view) {
    ivec2 cells = abuffer_camera_cells(s);
    return view == ABUFFER_CAMERA ? uint(max(cells.x, cells.y)) : ABUFFER_HEADER(s).resolution;
}

// Returns the first cell of the camera's view within its square.
ivec2 abuffer_camera_first(AbufferRef s) {
    ivec2 cells = abuffer_camera_cells(s);
    return (ivec2(max(cells.x, cells.y)) - cells) / 2;
}

// Finds the first and last cell of a view within its square, with the border: all cells of a face, the middle
// ones of the camera's square.
void abuffer_view_cells(AbufferRef s, uint view, out ivec2 lower, out ivec2 upper) {
    lower = ivec2(-1);
    upper = ivec2(ABUFFER_HEADER(s).resolution);
    if (view == ABUFFER_CAMERA) {
        lower += abuffer_camera_first(s);
        upper = lower + 1 + abuffer_camera_cells(s);
    }
}

// Returns the common centre of the views. This is a function because glslang does not terminate, with device
// addresses, if an expression that reads through a reference is precise.
vec3 abuffer_eye(AbufferRef s) {
    return ABUFFER_HEADER(s).eye;
}

// Returns a scalar product that must not be contracted, since build passes and traces must compute the same
// bits.
float abuffer_along(vec3 row, vec3 p) {
    precise float sum = row.x * p.x + row.y * p.y + row.z * p.z;
    return sum;
}

// Transforms a point relative to the eye, or a direction, into a view.
vec3 abuffer_view_from_world(AbufferRef s, vec3 p, uint view) {
    if (view != ABUFFER_CAMERA) {
        return face_from_world(p, view);
    }
    return vec3(abuffer_along(ABUFFER_HEADER(s).camera_x, p), abuffer_along(ABUFFER_HEADER(s).camera_y, p),
        abuffer_along(ABUFFER_HEADER(s).camera_z, p));
}

// Returns the width of a view's cell in the world, per metre of distance from the eye along the largest axis.
float abuffer_cell_slope(AbufferRef s, uint view) {
    if (view != ABUFFER_CAMERA) {
        return 2.0 / float(ABUFFER_HEADER(s).resolution);
    }
    // The rows of the camera's matrix are divided by the half width of its pyramid.
    float narrowest = min(length(ABUFFER_HEADER(s).camera_x), length(ABUFFER_HEADER(s).camera_y));
    return 2.0 / (narrowest * float(abuffer_resolution(s, view)));
}

// Returns the number of cells of the cube, which come before the cells of the camera's view.
uint abuffer_cube_cells(AbufferRef s) {
    return ABUFFER_HAS_CUBE ? VIEW_FACES * face_cells(ABUFFER_HEADER(s).resolution) : 0u;
}

// Returns the number of cells of all views.
uint abuffer_cell_count(AbufferRef s) {
    ivec2 camera = abuffer_camera_cells(s) + 2;
    return abuffer_cube_cells(s) + (ABUFFER_HAS_CAMERA ? uint(camera.x * camera.y) : 0u);
}

// Returns the running index of a view's cell over all views; abuffer_cell_count if the view has no such cell.
uint abuffer_cell(AbufferRef s, uint view, ivec2 cell) {
    if (view != ABUFFER_CAMERA) {
        return cell_index(view, cell, ABUFFER_HEADER(s).resolution);
    }
    ivec2 lower;
    ivec2 upper;
    abuffer_view_cells(s, view, lower, upper);
    if (any(lessThan(cell, lower)) || any(greaterThan(cell, upper))) {
        return abuffer_cell_count(s);
    }
    ivec2 place = cell - lower;
    return abuffer_cube_cells(s) + uint(place.y * (upper.x - lower.x + 1) + place.x);
}

#endif

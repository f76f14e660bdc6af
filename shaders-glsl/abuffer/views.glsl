// The views of an A-buffer: the faces of a cube around the eye, what the camera at the eye sees, or both.
// Reads: header. Writes: nothing.
// Source: MMRT section 3.1. Every face is a pyramid |x| <= z, |y| <= z with a border of one cell; the
// camera's view is the middle of one, as wide or as high. Turning a point into it rounds, turning one into a face does not.
#ifndef ABUFFER_VIEWS_GLSL
#define ABUFFER_VIEWS_GLSL

#include "abuffer/header.glsl"
#include "ads/views.glsl"

// Returns columns and rows of the camera's view without the border, both even or both odd.
ivec2 abuffer_camera_cells(AbufferRef s) {
    uint cells = ABUFFER_HEADER(s).camera_cells;
    return ivec2(cells & 0xFFFFu, cells >> 16);
}

// Returns the number of cells along a side of the square around a view, without the border.
uint abuffer_resolution(AbufferRef s, uint view) {
    ivec2 cells = abuffer_camera_cells(s);
    return view == ABUFFER_CAMERA ? uint(max(cells.x, cells.y)) : ABUFFER_HEADER(s).resolution;
}

// Returns the first cell of the camera's view within its square.
ivec2 abuffer_camera_first(AbufferRef s) {
    ivec2 cells = abuffer_camera_cells(s);
    return (ivec2(max(cells.x, cells.y)) - cells) / 2;
}

// Returns the cells of a view within its square, with the border: all of a face, the middle ones of the
// camera.
void abuffer_view_cells(AbufferRef s, uint view, out ivec2 lower, out ivec2 upper) {
    lower = ivec2(-1);
    upper = ivec2(ABUFFER_HEADER(s).resolution);
    if (view == ABUFFER_CAMERA) {
        lower += abuffer_camera_first(s);
        upper = lower + 1 + abuffer_camera_cells(s);
    }
}

// Returns the common centre of the views. It is a function because, with addresses, glslang does not end if
// precise expressions follow a reference.
vec3 abuffer_eye(AbufferRef s) {
    return ABUFFER_HEADER(s).eye;
}

// Returns a scalar product without contraction, since passes and traces must agree.
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

// Returns the width of a cell per metre of distance from the eye along the largest axis of its view, in the
// world.
float abuffer_cell_slope(AbufferRef s, uint view) {
    if (view != ABUFFER_CAMERA) {
        return 2.0 / float(ABUFFER_HEADER(s).resolution);
    }
    // Rows are scaled by one over the half width of the pyramid.
    float narrowest = min(length(ABUFFER_HEADER(s).camera_x), length(ABUFFER_HEADER(s).camera_y));
    return 2.0 / (narrowest * float(abuffer_resolution(s, view)));
}

// Returns the number of cells of the cube, which come before those of the camera.
uint abuffer_cube_cells(AbufferRef s) {
    return ABUFFER_HAS_CUBE ? VIEW_FACES * face_cells(ABUFFER_HEADER(s).resolution) : 0u;
}

// Returns the number of cells of all views.
uint abuffer_cell_count(AbufferRef s) {
    ivec2 camera = abuffer_camera_cells(s) + 2;
    return abuffer_cube_cells(s) + (ABUFFER_HAS_CAMERA ? uint(camera.x * camera.y) : 0u);
}

// Returns the running index of a cell of a view over all views; abuffer_cell_count if the view has no such
// cell.
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

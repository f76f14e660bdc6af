// What: the views of an A-buffer: the faces of a cube around the eye, what the camera at the eye sees, or both.
// Reads: header. Writes: nothing.
// Source: MMRT section 3.1. Every view is a pyramid |x| <= z, |y| <= z with a border of one cell; turning a
// point into the camera's rounds, turning it into a face does not.
#ifndef ABUFFER_VIEWS_GLSL
#define ABUFFER_VIEWS_GLSL

#include "abuffer/header.glsl"
#include "ads/views.glsl"

// Cells a side, border not counted.
uint abuffer_resolution(AbufferRef s, uint view) {
    return view == ABUFFER_CAMERA ? ABUFFER_HEADER(s).camera_resolution : ABUFFER_HEADER(s).resolution;
}

// Common centre of the views. A function: with addresses, glslang does not end where precise expressions
// follow a reference.
vec3 abuffer_eye(AbufferRef s) {
    return ABUFFER_HEADER(s).eye;
}

// A scalar product without contraction: passes and traces must agree.
float abuffer_along(vec3 row, vec3 p) {
    precise float sum = row.x * p.x + row.y * p.y + row.z * p.z;
    return sum;
}

// A point relative to the eye, or a direction, in a view.
vec3 abuffer_view_from_world(AbufferRef s, vec3 p, uint view) {
    if (view != ABUFFER_CAMERA) {
        return face_from_world(p, view);
    }
    return vec3(abuffer_along(ABUFFER_HEADER(s).camera_x, p), abuffer_along(ABUFFER_HEADER(s).camera_y, p),
        abuffer_along(ABUFFER_HEADER(s).camera_z, p));
}

// Width of a cell a metre of distance from the eye along the largest axis of its view, in the world.
float abuffer_cell_slope(AbufferRef s, uint view) {
    if (view != ABUFFER_CAMERA) {
        return 2.0 / float(ABUFFER_HEADER(s).resolution);
    }
    // Rows are as long as the pyramid is narrow.
    float narrowest = min(length(ABUFFER_HEADER(s).camera_x), length(ABUFFER_HEADER(s).camera_y));
    return 2.0 / (narrowest * float(ABUFFER_HEADER(s).camera_resolution));
}

// Cells of the cube, which come before those of the camera.
uint abuffer_cube_cells(AbufferRef s) {
    return ABUFFER_HAS_CUBE ? VIEW_FACES * face_cells(ABUFFER_HEADER(s).resolution) : 0u;
}

// Cells of all views.
uint abuffer_cell_count(AbufferRef s) {
    return abuffer_cube_cells(s) + (ABUFFER_HAS_CAMERA ? face_cells(ABUFFER_HEADER(s).camera_resolution) : 0u);
}

// Running index of a cell of a view over all views.
uint abuffer_cell(AbufferRef s, uint view, ivec2 cell) {
    uint index = cell_index(view == ABUFFER_CAMERA ? 0u : view, cell, abuffer_resolution(s, view));
    return view == ABUFFER_CAMERA ? abuffer_cube_cells(s) + index : index;
}

#endif

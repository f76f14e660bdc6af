// The six views of a cube around the eye, called faces, and the exact partition of space between them.
// Reads, writes: nothing.
// Face f looks along axis f / 2, in the positive direction if f is even. Transforming a point into the space
// of a face permutes its coordinates and may change a sign, which is exact. In face space, depth is z.
#ifndef ADS_VIEWS_GLSL
#define ADS_VIEWS_GLSL

#define VIEW_FACES 6u

// Transforms a point, relative to the eye, into the space of a face. The pyramid of the face is |x| <= z, |y|
// <= z.
vec3 face_from_world(vec3 p, uint face) {
    vec3 q = face < 2u ? p.yzx : (face < 4u ? p.zxy : p.xyz);
    q.z = (face & 1u) != 0u ? -q.z : q.z;
    return q;
}

// Returns the face whose pyramid holds p. Of equal coordinates x comes first, then y.
uint face_of(vec3 p) {
    vec3 m = abs(p);
    if (m.x >= m.y && m.x >= m.z) {
        return p.x < 0.0 ? 1u : 0u;
    }
    if (m.y >= m.z) {
        return p.y < 0.0 ? 3u : 2u;
    }
    return p.z < 0.0 ? 5u : 4u;
}

// A face with `resolution` cells along a side covers x/z and y/z in [-1, 1]. It has a border of one cell on
// each side, so that a point within a cell of a seam is found in both faces. Columns and rows are numbered
// from -1 to `resolution`, both of which are the border.

// Returns x/z of the boundary between cells i - 1 and i. The result is exact if `resolution` is a power of
// two.
float cell_boundary(int i, uint resolution) {
    precise float c = float(2 * i - int(resolution)) * (1.0 / float(resolution));
    return c;
}

// Returns x/z of the centre of cell i.
float cell_center(int i, uint resolution) {
    precise float c = float(2 * i + 1 - int(resolution)) * (1.0 / float(resolution));
    return c;
}

// Returns the number of cells of one face with its border.
uint face_cells(uint resolution) {
    return (resolution + 2u) * (resolution + 2u);
}

// Returns the index of a cell among the cells of all faces, borders included.
uint cell_index(uint face, ivec2 cell, uint resolution) {
    uint side = resolution + 2u;
    return (face * side + uint(cell.y + 1)) * side + uint(cell.x + 1);
}

#endif

// The six views of a cube around the eye and the exact partition of space between them.
// Reads, writes: nothing.
// Face f looks along axis f / 2, positive for even f. Turning a point into face space is a
// permutation and a change of sign, hence exact; depth is z.
#ifndef ADS_VIEWS_GLSL
#define ADS_VIEWS_GLSL

#define VIEW_FACES 6u

// Transforms a point into face space. The pyramid of a face is |x| <= z, |y| <= z.
vec3 face_from_world(vec3 p, uint face) {
    vec3 q = face < 2u ? p.yzx : (face < 4u ? p.zxy : p.xyz);
    q.z = (face & 1u) != 0u ? -q.z : q.z;
    return q;
}

// Returns the face whose pyramid holds p. Ties go to x, then y, then z.
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

// A face of `resolution` cells along a side covers x/z and y/z in [-1, 1]; one more cell on every side is
// its border, so that a point within a cell of a seam is found in both faces. Cell (i, j) counts
// from -1 to resolution.

// Returns x/z of the boundary below cell i, exact if resolution is a power of two.
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

// Returns the running index of a cell over all faces.
uint cell_index(uint face, ivec2 cell, uint resolution) {
    uint side = resolution + 2u;
    return (face * side + uint(cell.y + 1)) * side + uint(cell.x + 1);
}

#endif

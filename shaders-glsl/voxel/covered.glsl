// Decides which cells of the axis A-buffers a triangle has a fragment in, and finds the fragment's depth and
// its voxel; the same for every builder.
// Reads: geometry, header. Writes: voxels, normals.
// The raster builder draws one instance per view, or one in all if a triangle is drawn only into the view
// that it faces most. Draws have no attachments and so no layers: the view is a varying.
#ifndef VOXEL_COVERED_GLSL
#define VOXEL_COVERED_GLSL

#include "ads/geometry.glsl"
#include "ads/reached.glsl"
#include "voxel/lists.glsl"
#include "voxel/names.glsl"
#include "ads/build_constants.glsl"

// Returns the corners of a triangle in the frame of a view.
void voxel_view_vertices(AxisView view, uint primitive, out vec3 a, out vec3 b, out vec3 c) {
    geometry_vertices(primitive, a, b, c);
    a = axis_from_world(view, a);
    b = axis_from_world(view, b);
    c = axis_from_world(view, c);
}

// Returns a triangle's unit normal, in the frame of its corners.
vec3 voxel_unit_normal(vec3 a, vec3 b, vec3 c) {
    vec3 normal = cross(b - a, c - a);
    // The normal is scaled first, so that no square overflows or vanishes.
    float largest = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
    return largest > 0.0 ? normalize(normal / largest) : vec3(0.0);
}

// Fragment of a triangle in a cell.
struct VoxelFound {
    uint list;            // running index of the cell
    uint voxel;           // running index of the voxel in which the fragment lies
    // depth, metres; with conservative coverage a word of ads/reached.glsl
    float z;
    // weights of vertices 1 and 2 at the cell's centre
    vec2 barycentrics;
};

// Returns the cell of a fragment invocation. The viewport has a border of one cell.
ivec2 voxel_cell_at_fragment(vec4 frag_coord) {
    return ivec2(frag_coord.xy) - 1;
}

// Finds the fragment of a triangle in a cell. Returns false if the triangle has no fragment there.
bool voxel_fragment(uint primitive, uint axis, ivec2 cell, out VoxelFound found) {
    AxisView view = voxel_view(build.structure, axis);
    vec3 a;
    vec3 b;
    vec3 c;
    found = VoxelFound(0u, 0xFFFFFFFFu, 0.0, vec2(1.0 / 3.0));
    if (any(lessThan(cell, ivec2(0))) || any(greaterThanEqual(cell, ivec2(view.resolution)))) {
        return false;
    }
    voxel_view_vertices(view, primitive, a, b, c);
    float span = 0.0;
    if (VOXEL_COVERAGE == VOXEL_COVERAGE_CONSERVATIVE) {
        if (!axis_reaches_into(view, a, b, c, cell)) {
            return false;
        }
        found.z = reached_depth(view, a, b, c, cell, span);
    } else if (VOXEL_COVERAGE == VOXEL_COVERAGE_EXACT) {
        if (!axis_at_center(view, a, b, c, cell, found.z, found.barycentrics)) {
            return false;
        }
    } else {
        // With coverage by the rasterizer the depth is that of the plane, limited to the depths of the
        // corners.
        vec3 center = axis_center(view, cell);
        precise vec3 ab = b - a;
        precise vec3 ac = c - a;
        precise vec3 normal = ab.yzx * ac.zxy - ab.zxy * ac.yzx;
        if (normal.z == 0.0) {
            return false;
        }
        precise float z = a.z + ((a.x - center.x) * normal.x + (a.y - center.y) * normal.y) / normal.z;
        found.z = clamp(z, min(a.z, min(b.z, c.z)), max(a.z, max(b.z, c.z)));
        found.barycentrics = clamp(triangle_barycentrics(vec3(center.xy, found.z), a, b, c), 0.0, 1.0);
    }
    found.list = axis_cell_index(axis, cell, view.resolution);
    // The place is in voxels. It is precise, like everything that decides whether a fragment is kept, since a
    // pass that counts and a pass that stores must decide alike.
    float voxels_per_metre = VOXEL_HEADER(build.structure).voxels_per_metre;
    precise vec3 place = vec3(axis_center(view, cell).xy, found.z) * voxels_per_metre;
    ivec3 voxel = clamp(ivec3(floor(place)), ivec3(0), ivec3(VOXEL_HEADER(build.structure).grid) - 1);
    found.voxel = voxel_index(build.structure, axis_to_world(voxel, axis));
    if (VOXEL_COVERAGE == VOXEL_COVERAGE_CONSERVATIVE) {
        found.z = reached_word(view, found.z, span);
    }
    return true;
}

// Marks the voxel in which a fragment lies, and adds the normal of the fragment's triangle to the voxel's
// sum.
void voxel_fill(uint primitive, VoxelFound found) {
    vec3 a;
    vec3 b;
    vec3 c;
    geometry_vertices(primitive, a, b, c);
    voxel_mark(build.structure, found.voxel, VOXEL_OCCUPIED);
    voxel_add_normal(build.structure, found.voxel, voxel_unit_normal(a, b, c));
}

#endif

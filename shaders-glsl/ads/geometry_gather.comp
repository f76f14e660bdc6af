// Gathers indices: turns those of an engine (u16 or u32, with a first index and a base vertex per draw) into
// absolute u32 indices in the order of the triangles, or copies the indices of a part's triangles.
// Reads: draws of GEOMETRY_SET, indices in a buffer of the embedder's. Writes: indices of GEOMETRY_SET, and
// the bit GEOMETRY_NOT_GATHERED of the stamp.
// One invocation per triangle.
#version 460
#include "contract/extensions.glsl"
#include "ads/constants.glsl"

layout(local_size_x = 64) in;

#define GEOMETRY_GATHERED
#define GEOMETRY_WRITTEN
#include "ads/gathered.glsl"

void main() {
    uint primitive = gl_LocalInvocationIndex
                   + gl_WorkGroupSize.x * (gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y);
    if (primitive == 0u) {
        geometry_header.stamp &= ~GEOMETRY_NOT_GATHERED;
    }
    if (primitive >= geometry_triangle_count()) {
        return;
    }
    uvec3 vertices = gathered_triangle(primitive);
    for (uint corner = 0u; corner < 3u; corner++) {
        geometry_indices[3u * primitive + corner] = vertices[corner];
    }
}

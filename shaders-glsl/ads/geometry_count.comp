// Reads the number of triangles, if only the device knows it. Triangles beyond the maximum number do not
// exist, and are counted as outside.
// Reads: the count, in a buffer of the embedder's. Writes: triangle_count, outside and stamp in the header of
// GEOMETRY_SET; arguments of the draws of all triangles onto 1 to GEOMETRY_DRAW_VIEWS views.
// One invocation.
#version 460
#include "contract/extensions.glsl"
#include "ads/constants.glsl"

layout(local_size_x = 1) in;

#define GEOMETRY_WRITTEN
#include "ads/geometry.glsl"

// The place of the count, and what follows from it. 16 bytes.
layout(push_constant, scalar) uniform GeometryCountConstants {
    uint count_word;     // word of the count in the buffer that is bound
    uint most_triangles; // the maximum number of triangles
    uint first_stamp;    // first of GEOMETRY_COUNT_STAMPS stamps that no other geometry has
    uint stamp_flags;    // bits of a new stamp: GEOMETRY_NOT_GATHERED if indices will be gathered, else 0
} pushed;
layout(set = 1, binding = 0, scalar) readonly buffer GeometryCountBuffer {
    uint geometry_counts[];
};
layout(set = 1, binding = 1, scalar) writeonly buffer GeometryDrawArgumentBuffer {
    uvec4 geometry_draw_arguments[];   // vertices, instances, first vertex, first instance
};

void main() {
    uint triangles = min(geometry_counts[pushed.count_word], pushed.most_triangles);
    // If the number of triangles has changed, earlier builds are not of these triangles, so there is a new
    // stamp.
    if (geometry_header.stamp == 0u || triangles != geometry_header.triangle_count) {
        uint step = STATUS_FLAGS + 1u;
        uint taken = geometry_header.stamp == 0u ? 0u : (geometry_header.stamp - pushed.first_stamp) / step + 1u;
        geometry_header.stamp = (pushed.first_stamp + step * (taken % GEOMETRY_COUNT_STAMPS)) | pushed.stamp_flags;
    }
    geometry_header.triangle_count = triangles;
    geometry_header.outside = geometry_counts[pushed.count_word] - triangles;
    for (uint views = 1u; views <= GEOMETRY_DRAW_VIEWS; views++) {
        geometry_draw_arguments[views - 1u] = uvec4(3u * triangles, views, 0u, 0u);
    }
}

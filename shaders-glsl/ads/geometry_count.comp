// The number of triangles, where only the device knows it: one invocation. Those beyond the maximum do not exist,
// and are counted as outside.
// Reads: the count, in a buffer of the embedder's. Writes: triangle_count, outside and stamp of GEOMETRY_SET's header, and
// the arguments of the draws of all triangles onto 1 to GEOMETRY_DRAW_VIEWS views.
#version 460
#include "contract/extensions.glsl"
#include "ads/constants.glsl"

layout(local_size_x = 1) in;

#define GEOMETRY_WRITTEN
#include "ads/geometry.glsl"

// Place of the count, and its maximum. 16 bytes.
layout(push_constant, scalar) uniform GeometryCountConstants {
    uint count_word;     // of the count, in what is bound
    uint most_triangles; // the maximum
    uint first_stamp;    // of GEOMETRY_COUNT_STAMPS stamps that no other geometry has
    uint stamp_flags;    // of a new stamp: GEOMETRY_NOT_GATHERED where indices are gathered, else 0
} pushed;
layout(set = 1, binding = 0, scalar) readonly buffer GeometryCountBuffer {
    uint geometry_counts[];
};
layout(set = 1, binding = 1, scalar) writeonly buffer GeometryDrawArgumentBuffer {
    uvec4 geometry_draw_arguments[];   // vertices, instances, first vertex, first instance
};

void main() {
    uint triangles = min(geometry_counts[pushed.count_word], pushed.most_triangles);
    // If triangles were added or removed, an earlier build is not of these triangles.
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

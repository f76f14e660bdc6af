// Finds the length of the longest list, where lists are not bisected. In the worst case a ray reads as many
// entries at a time.
// Reads: header, lists, fragments. Writes: header.longest, header.corrupted. One invocation per list.
// Source: not in the papers, in which rays read lists to their ends, whatever their length.
#version 460
#include "contract/extensions.glsl"
#include "voxel/lists.glsl"
#include "voxel/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint list = build_invocation();
    if (list >= voxel_list_count(build.structure)
        || VOXEL_HEADER(build.structure).demand > VOXEL_HEADER(build.structure).capacity) {
        return;
    }
    uint length = 0u;
    VoxelCursor cursor = voxel_list_begin(build.structure, list);
    while (cursor.link != 0u && length < VOXEL_LONGEST_LIMIT) {
        voxel_list_next(build.structure, cursor);
        length++;
    }
    // Most lists are shorter than a list that was found before, so most invocations need no atomic operation.
    if (length > VOXEL_HEADER(build.structure).longest) {
        atomicMax(VOXEL_HEADER(build.structure).longest, length < VOXEL_LONGEST_LIMIT ? length : 0xFFFFFFFFu);
    }
}

// Computes how far bricks are empty along slices and columns together, towards each of four quadrants.
// Reads: bricks. Writes: distances.
// One invocation per line of bricks along columns.
// Source: not in the paper; bricks/distance.glsl.
#version 460
#include "contract/extensions.glsl"
#include "bricks/accessors.glsl"
#include "bricks/distance.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint line = build_invocation();
    uvec3 bricks = bricks_cells(build.structure) >> 2;
    uint deep = bricks.z;
    if (line >= bricks_view_count() * bricks.y * deep) {
        return;
    }
    uint first = line / deep * bricks.x * deep + line % deep;
    // The runs of reaches towards lower slices (x) and towards higher slices (y).
    uvec2 runs = uvec2(BRICKS_RUNS_BEGIN);
    for (uint x = 0u; x < bricks.x; x++) {
        uint brick = first + x * deep;
        uint word = BRICKS_POOL(build.structure, bricks)[bricks_at(brick)];
        bool empty = bricks_is_empty(word);
        runs.x = bricks_runs_with(runs.x, empty ? word & 15u : 0u);
        runs.y = bricks_runs_with(runs.y, empty ? word >> 4 & 15u : 0u);
        BRICKS_DISTANCES(build.structure)[brick] = bricks_reach_of(runs.x) | bricks_reach_of(runs.y) << 4;
    }
    runs = uvec2(BRICKS_RUNS_BEGIN);
    for (uint x = bricks.x; x-- > 0u;) {
        uint brick = first + x * deep;
        uint word = BRICKS_POOL(build.structure, bricks)[bricks_at(brick)];
        bool empty = bricks_is_empty(word);
        runs.x = bricks_runs_with(runs.x, empty ? word & 15u : 0u);
        runs.y = bricks_runs_with(runs.y, empty ? word >> 4 & 15u : 0u);
        BRICKS_DISTANCES(build.structure)[brick] |= bricks_reach_of(runs.x) << 8 | bricks_reach_of(runs.y) << 12;
    }
}

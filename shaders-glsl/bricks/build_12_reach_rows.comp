// Computes how far bricks are empty along all three axes together, towards each of eight octants.
// Reads: distances. Writes: bricks (words of empty ones).
// One invocation per line of bricks along rows.
// Source: not in the paper; bricks/distance.glsl.
#version 460
#include "contract/extensions.glsl"
#include "bricks/accessors.glsl"
#include "bricks/distance.glsl"
#include "bricks/names.glsl"
#include "ads/build_constants.glsl"
#include "ads/build_invocation.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

// Extends the runs of four octants by the reaches that a brick has towards them.
void lengthen(inout uint runs[4], uint reaches) {
    for (uint q = 0u; q < 4u; q++) {
        runs[q] = bricks_runs_with(runs[q], reaches >> (4u * q) & 15u);
    }
}

uint reaches_of(uint runs[4]) {
    return bricks_reach_of(runs[0]) | bricks_reach_of(runs[1]) << 4 | bricks_reach_of(runs[2]) << 8 | bricks_reach_of(runs[3]) << 12;
}

void main() {
    uint line = build_invocation();
    uvec3 bricks = bricks_cells(build.structure) >> 2;
    uint stride = bricks.x * bricks.z;
    if (line >= bricks_view_count() * stride) {
        return;
    }
    uint first = line / stride * bricks.y * stride + line % stride;
    uint runs[4] = uint[4](BRICKS_RUNS_BEGIN, BRICKS_RUNS_BEGIN, BRICKS_RUNS_BEGIN, BRICKS_RUNS_BEGIN);
    for (uint y = 0u; y < bricks.y; y++) {
        uint brick = first + y * stride;
        uint reaches = BRICKS_DISTANCES(build.structure)[brick];
        lengthen(runs, reaches);
        if (reaches != 0u) {
            if (BRICKS_DEPTH != 0u) {
                BRICKS_POOL(build.structure, bricks)[bricks_layer_at(brick)] = reaches;
            }
            // Until the loop in the other direction, the word holds the reaches towards lower rows.
            BRICKS_POOL(build.structure, bricks)[bricks_at(brick)] = BRICKS_EMPTY | reaches_of(runs);
        }
    }
    runs = uint[4](BRICKS_RUNS_BEGIN, BRICKS_RUNS_BEGIN, BRICKS_RUNS_BEGIN, BRICKS_RUNS_BEGIN);
    for (uint y = bricks.y; y-- > 0u;) {
        uint brick = first + y * stride;
        uint reaches = BRICKS_DISTANCES(build.structure)[brick];
        lengthen(runs, reaches);
        if (reaches != 0u) {
            uint lower = BRICKS_POOL(build.structure, bricks)[bricks_at(brick)] & 0xFFFFu;
            BRICKS_POOL(build.structure, bricks)[bricks_at(brick)] = bricks_empty_word(lower | reaches_of(runs) << 16);
        }
    }
}

// Divides the crowded cells of a level: those that list more than BRICKS_CROWDED small triangles. Each gets a
// brick of the next level.
// Reads: lists, header. Writes: bricks, header.brick_demand, header.brick_groups, lists (zeros).
// One invocation per brick of the level.
// Source: not in the paper.
#version 460
#include "contract/extensions.glsl"
#include "bricks/level.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

// Returns the crowded cells of a brick, as a mask.
uvec2 crowded_cells(uvec2 mask, uint first) {
    uint lists = BRICKS_HEADER(build.structure).cell_capacity;
    uvec2 crowded = uvec2(0u);
    uint word;
    uint bit;
    for (uint list = first; list < lists && bricks_take_cell(mask, word, bit); list++) {
        if (BRICKS_SMALL_COUNT(build.structure, list) > BRICKS_CROWDED) {
            crowded[word] |= 1u << bit;
        }
    }
    return crowded;
}

void main() {
    if (all(greaterThanEqual(uvec3(build.step), BRICKS_HEADER(build.structure).depths))) {
        return;
    }
    ivec3 side = bricks_side(build.structure, build.step);
    uvec2 range = bricks_level_bricks();
    for (uint brick = range.x; brick < range.y; brick += BRICKS_LEVEL_STRIDE) {
        uvec2 mask = bricks_mask(build.structure, brick);
        uint list = BRICKS_POOL(build.structure, bricks)[bricks_at(brick)];
        uvec2 crowded = crowded_cells(mask, list);
        uint count = uint(bitCount(crowded.x) + bitCount(crowded.y));
        if (count == 0u) {
            continue;
        }
        uint child = atomicAdd(BRICKS_HEADER(build.structure).brick_demand, count);
        if (child + count > BRICKS_HEADER(build.structure).brick_capacity) {
            continue;
        }
        uvec3 place = bricks_place_of(build.structure, brick, build.step);
        for (uint word = 0u; word < 2u; word++) {
            BRICKS_POOL(build.structure, bricks)[bricks_mask_at(brick, word)] = mask[word] & ~crowded[word];
            BRICKS_POOL(build.structure, bricks)[bricks_divided_at(brick, word)] = crowded[word];
        }
        uvec2 left = crowded;
        uint word;
        uint bit;
        for (uint at = bricks_place_at(child); bricks_take_cell(left, word, bit); at += BRICKS_STRIDE) {
            BRICKS_POOL(build.structure, lists)[list + bricks_rank(mask, word, bit)] = 0u;
            uvec3 cell = uvec3(side) * place + uvec3(bricks_cell_of_bit(word, bit));
            BRICKS_POOL(build.structure, bricks)[at] = cell.x | cell.y << 16;
            BRICKS_POOL(build.structure, bricks)[at + 1u] = cell.z;
        }
        BRICKS_POOL(build.structure, bricks)[bricks_child_at(brick)] = child;
        uint of_level = child + count - BRICKS_HEADER(build.structure).brick_first[build.step + 1u];
        uint groups = (of_level + BUILD_GROUP_SIZE - 1u) / BUILD_GROUP_SIZE;
        atomicMax(BRICKS_HEADER(build.structure).brick_groups[3u * (build.step + 1u)], min(groups, BRICKS_GROUPS_MOST));
    }
}

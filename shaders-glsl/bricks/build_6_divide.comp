// Divides the cells of a level that list more than BRICK_CROWDED small triangles: each gets a brick of the next level.
// One invocation per brick of the level.
// Reads: lists, header. Writes: bricks, header.brick_demand, header.brick_groups, lists (zeros).
// Source: not in the paper.
#version 460
#include "contract/extensions.glsl"
#include "bricks/level.glsl"

layout(local_size_x = BRICK_GROUP_SIZE) in;

// Cells of a brick that are crowded, as a mask.
uvec2 crowded_cells(uvec2 mask, uint first) {
    uint lists = BRICK_HEADER(build.structure).cell_capacity;
    uvec2 crowded = uvec2(0u);
    uint word;
    uint bit;
    for (uint list = first; list < lists && brick_take_cell(mask, word, bit); list++) {
        if (BRICK_SMALL_COUNT(build.structure, list) > BRICK_CROWDED) {
            crowded[word] |= 1u << bit;
        }
    }
    return crowded;
}

void main() {
    if (all(greaterThanEqual(uvec3(build.step), BRICK_HEADER(build.structure).depths))) {
        return;
    }
    ivec3 side = brick_side(build.structure, build.step);
    uvec2 range = brick_level_bricks();
    for (uint brick = range.x; brick < range.y; brick += BRICK_LEVEL_STRIDE) {
        uvec2 mask = brick_mask(build.structure, brick);
        uint list = BRICK_POOL(build.structure, bricks)[brick_at(brick)];
        uvec2 crowded = crowded_cells(mask, list);
        uint count = uint(bitCount(crowded.x) + bitCount(crowded.y));
        if (count == 0u) {
            continue;
        }
        uint child = atomicAdd(BRICK_HEADER(build.structure).brick_demand, count);
        if (child + count > BRICK_HEADER(build.structure).brick_capacity) {
            continue;
        }
        uvec3 place = brick_place_of(build.structure, brick, build.step);
        for (uint word = 0u; word < 2u; word++) {
            BRICK_POOL(build.structure, bricks)[brick_mask_at(brick, word)] = mask[word] & ~crowded[word];
            BRICK_POOL(build.structure, bricks)[brick_divided_at(brick, word)] = crowded[word];
        }
        uvec2 left = crowded;
        uint word;
        uint bit;
        for (uint at = brick_place_at(child); brick_take_cell(left, word, bit); at += BRICK_STRIDE) {
            BRICK_POOL(build.structure, lists)[list + brick_rank(mask, word, bit)] = 0u;
            uvec3 cell = uvec3(side) * place + uvec3(brick_cell_of_bit(word, bit));
            BRICK_POOL(build.structure, bricks)[at] = cell.x | cell.y << 16;
            BRICK_POOL(build.structure, bricks)[at + 1u] = cell.z;
        }
        BRICK_POOL(build.structure, bricks)[brick_child_at(brick)] = child;
        uint of_level = child + count - BRICK_HEADER(build.structure).brick_first[build.step + 1u];
        uint groups = (of_level + BRICK_GROUP_SIZE - 1u) / BRICK_GROUP_SIZE;
        atomicMax(BRICK_HEADER(build.structure).brick_groups[3u * (build.step + 1u)], min(groups, BRICK_GROUPS_MOST));
    }
}

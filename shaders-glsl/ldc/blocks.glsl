// Numbers the blocks of both levels of a layered depth cube, and reads and widens the depths in them.
// Reads, writes: header, blocks.
// Source: Bürger et al. section 1.3, minimum and maximum depth per block. Slices and the second level are
// not in the paper.
#ifndef LDC_BLOCKS_GLSL
#define LDC_BLOCKS_GLSL

#include "ads/bucket.glsl"
#include "ldc/accessors.glsl"

// Returns how many columns and rows of cells a block of a level has.
ivec2 ldc_block_cells(uint level) {
    return ivec2(LDC_BLOCK_COLUMNS, LDC_BLOCK_ROWS) * int(level == 0u ? 1u : LDC_LEVEL_BLOCKS);
}

// Returns how many columns and rows of blocks of a level a view has. The last blocks may reach beyond the
// cells.
ivec2 ldc_view_blocks(uint resolution, uint level) {
    return (int(resolution) + ldc_block_cells(level) - 1) / ldc_block_cells(level);
}

// Returns the running index of a block over all views. The blocks of the second level follow those of the
// first.
uint ldc_block(uint resolution, uint level, uint axis, ivec2 block) {
    ivec2 first = ldc_view_blocks(resolution, 0u);
    ivec2 blocks = ldc_view_blocks(resolution, level);
    uint before = level == 0u ? 0u : AXIS_VIEWS * uint(first.x * first.y);
    return before + uint((int(axis) * blocks.y + block.y) * blocks.x + block.x);
}

// Returns the number of words of a block.
uint ldc_block_stride() {
    return LDC_OCCUPANCY == LDC_OCCUPANCY_SLICES ? 4u : 2u;
}

// Returns the bits of the slices from that of z_low to that of z_high. The slice of a depth is a monotone
// function of the depth, so the bits cover all depths in between.
uvec2 ldc_slices(float slices_per_metre, float z_low, float z_high) {
    int first = int(bucket_of(z_low, 0.0, slices_per_metre, LDC_SLICES));
    int last = int(bucket_of(z_high, 0.0, slices_per_metre, LDC_SLICES));
    uvec2 bits = uvec2(0u);
    for (int word = 0; word < 2; word++) {
        int from = max(first - 32 * word, 0);
        int to = min(last - 32 * word, 31);
        if (from <= to) {
            bits[word] = 0xFFFFFFFFu << uint(from) & 0xFFFFFFFFu >> uint(31 - to);
        }
    }
    return bits;
}

// Widens the depths of the blocks that contain a cell. Word 0 holds the complement of the smallest depth's
// bits, so that a cleared block is empty and atomicMax widens both ends: depths are not negative and order
// like their bits. Each word is read first, since most fragments change none and need no atomic operation.
void ldc_widen_blocks(LdcRef s, uint axis, ivec2 cell, float z_low, float z_high) {
    uvec2 ends = uvec2(~floatBitsToUint(z_low), floatBitsToUint(z_high));
    uint resolution = LDC_HEADER(s).resolution;
    uvec2 slices = LDC_OCCUPANCY == LDC_OCCUPANCY_SLICES ? ldc_slices(LDC_HEADER(s).slices_per_metre, z_low, z_high)
        : uvec2(0u);
    for (uint level = 0u; level < LDC_LEVELS; level++) {
        uint word = ldc_block_stride() * ldc_block(resolution, level, axis, cell / ldc_block_cells(level));
        for (uint side = 0u; side < 2u; side++) {
            if (LDC_POOL(s, blocks)[word + side] < ends[side]) {
                atomicMax(LDC_POOL(s, blocks)[word + side], ends[side]);
            }
            if (LDC_OCCUPANCY == LDC_OCCUPANCY_SLICES && (slices[side] & ~LDC_POOL(s, blocks)[word + 2u + side]) != 0u) {
                atomicOr(LDC_POOL(s, blocks)[word + 2u + side], slices[side]);
            }
        }
    }
}

// Returns the depths of a block.
LdcBlock ldc_block_depths(LdcRef s, uint block) {
    uint word = ldc_block_stride() * block;
    uint low = LDC_POOL(s, blocks)[word];
    uvec2 slices = LDC_OCCUPANCY == LDC_OCCUPANCY_SLICES
        ? uvec2(LDC_POOL(s, blocks)[word + 2u], LDC_POOL(s, blocks)[word + 3u]) : uvec2(0xFFFFFFFFu);
    return LdcBlock(low == 0u, uintBitsToFloat(~low), uintBitsToFloat(LDC_POOL(s, blocks)[word + 1u]), slices);
}

#endif

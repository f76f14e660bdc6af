// A sparse octree over the voxels: how traces look a voxel up, and how the build numbers nodes.
// Reads: header; nodes (traces); voxels (build). Writes: header.corrupted.
// Source: child masks with one pointer after Laine and Karras 2010; each voxel is looked up from the root, as
// Crassin et al. 2009 do it.
//
// An octant of a node is a number of three bits, which say whether it is the upper one along x, y and z.
// A node of the upper levels is one word. Its low 8 bits say which of its octants hold something. The bits
// above them are the place of the first of these octants' nodes; the others follow in order.
// A node of the last level is a block of 2x2x2 voxels: one word with the bits of each voxel.
// The build numbers all nodes that there could be, level by level, and within a level in the order of
// octants. The nodes below node k have the numbers 8 k + 1 to 8 k + 8.
#ifndef VOXEL_OCTREE_GLSL
#define VOXEL_OCTREE_GLSL

#include "voxel/accessors.glsl"

// Returns the lowest number of a node of a level, which is the number of nodes in all levels above.
uint octree_first(uint level) {
    return ((1u << (3u * level)) - 1u) / 7u;
}

// Returns the number of nodes that the upper levels could have.
uint octree_upper_count(VoxelRef s) {
    return octree_first(VOXEL_HEADER(s).levels - 1u);
}

// Returns the bits of all voxels of a block; `number` counts the blocks of the last level.
uint octree_block(VoxelRef s, uint number) {
    ivec3 block = ivec3(0);
    for (uint bit = 0u; bit + 1u < VOXEL_HEADER(s).levels; bit++) {
        block |= ivec3(number >> (3u * bit), number >> (3u * bit + 1u), number >> (3u * bit + 2u)) % 2 << int(bit);
    }
    uint word = 0u;
    for (int octant = 0; octant < 8; octant++) {
        ivec3 voxel = 2 * block + ivec3(octant & 1, octant >> 1 & 1, octant >> 2);
        word |= voxel_bits(s, voxel_index(s, voxel)) << (VOXEL_BITS * uint(octant));
    }
    return word;
}

// Returns the word of a node. A place beyond the pool is counted as corrupted and gives 0, a node without
// octants.
uint octree_node(VoxelRef s, uint place) {
    if (place >= min(VOXEL_HEADER(s).node_capacity, VOXEL_HEADER(s).node_demand)) {
        atomicAdd(VOXEL_HEADER(s).corrupted, 1u);
        return 0u;
    }
    return VOXEL_POOL(s, nodes)[place];
}

// Returns the bits of a voxel. If they are zero, nothing lies in the block of 2^level voxels along a side
// that contains the voxel. `read` is the number of nodes that were read.
uint octree_bits(VoxelRef s, ivec3 voxel, out uint level, out uint read) {
    uint place = 0u;
    read = 0u;
    for (level = min(VOXEL_HEADER(s).levels, VOXEL_LEVEL_LIMIT) - 1u; level > 0u; level--) {
        uint word = octree_node(s, place);
        read++;
        ivec3 side = voxel >> int(level) & 1;
        uint octant = uint(side.x | side.y << 1 | side.z << 2);
        if ((word >> octant & 1u) == 0u) {
            return 0u;
        }
        place = (word >> 8) + uint(bitCount(word & ((1u << octant) - 1u)));
    }
    ivec3 side = voxel & 1;
    read++;
    return octree_node(s, place) >> (VOXEL_BITS * uint(side.x | side.y << 1 | side.z << 2)) & 15u;
}

#endif

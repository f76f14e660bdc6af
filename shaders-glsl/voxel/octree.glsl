// A sparse octree over the voxels: what it says of a voxel, and where its build keeps what.
// Reads: header, voxels and octants (build), nodes. Writes: header.corrupted.
// Source: child masks with one pointer after Laine and Karras 2010; each voxel is looked up from the root, as Crassin et al.
// 2009 do it.
//
// A node of the upper levels is a word: in its low 8 bits which of its octants hold something, above them the place of the
// first of these, which the others follow in order. A node of the last level is a block of 2x2x2 voxels: a word with the
// bits of each. An octant is a number of three bits: whether it is the upper one along x, y and z.
// The build numbers all nodes that could be, level by level and in each in the order of octants: those of node k are
// 8 k + 1 to 8 k + 8.
#ifndef VOXEL_OCTREE_GLSL
#define VOXEL_OCTREE_GLSL

#include "voxel/accessors.glsl"

// Returns the lowest number of a level, which is the number of nodes above the level.
uint octree_first(uint level) {
    return ((1u << (3u * level)) - 1u) / 7u;
}

// Returns the largest number of nodes of the upper levels.
uint octree_upper_count(VoxelRef s) {
    return octree_first(VOXEL_HEADER(s).levels - 1u);
}

// Returns the bits of the voxels of a block, by its number in the last level.
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

// Returns a node's word; that of a node without octants if the pool ends before the node, which is counted.
uint octree_node(VoxelRef s, uint place) {
    if (place >= min(VOXEL_HEADER(s).node_capacity, VOXEL_HEADER(s).node_demand)) {
        atomicAdd(VOXEL_HEADER(s).corrupted, 1u);
        return 0u;
    }
    return VOXEL_POOL(s, nodes)[place];
}

// Returns the bits of a voxel. If they are zero, the voxel lies in a block of 2^level voxels along a side
// that holds nothing. `read` is the number of nodes read.
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

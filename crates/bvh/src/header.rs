//! The tree's records as shaders see them: `shaders-glsl/bvh/types.glsl`, field by field.

use bytemuck::{Pod, Zeroable};
use rasray_shaders_glsl::constants::bvh::BVH_NONE;

/// `BvhHeader`: state and sizes of one tree.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Header {
    /// `STATUS_*` bits; without `STATUS_COMPLETE` traces answer "not ready".
    pub status: u32,
    /// Child reference of the whole tree; `BVH_NONE` without triangles.
    pub root: u32,
    /// Triangles in the tree.
    pub triangle_count: u32,
    /// Nodes the pool holds.
    pub node_capacity: u32,
    /// Triangle records the pool holds.
    pub record_capacity: u32,
    /// Words the scratch pool holds.
    pub scratch_capacity: u32,
    /// Word of the scratch pool with the primitive of the first record.
    pub order_offset: u32,
    /// Words from one to the next.
    pub order_stride: u32,
    /// Lower corner of the geometry, metres relative to the frame origin.
    pub lower: [f32; 3],
    /// Zero.
    pub spare_lower: f32,
    /// Cells of the Morton grid a metre, an axis.
    pub cells_per_metre: [f32; 3],
    /// References that named no node or record.
    pub corrupted: u32,
    /// Device address of the nodes; zero with descriptors.
    pub nodes_address: [u32; 2],
    /// Device address of the triangle records.
    pub records_address: [u32; 2],
    /// Device address of the scratch pool.
    pub scratch_address: [u32; 2],
    /// Zero.
    pub spare_address: [u32; 2],
}

/// `BvhNode`: the boxes of both children of an inner node.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Node {
    /// Lower corner of the first child, metres relative to the frame origin.
    pub lower_0: [f32; 3],
    /// Reference of the first child: a node's number, or a leaf.
    pub child_0: u32,
    /// Upper corner of the first child.
    pub upper_0: [f32; 3],
    /// Reference of the second child.
    pub child_1: u32,
    /// Lower corner of the second child.
    pub lower_1: [f32; 3],
    /// Link by which this node is reached: twice the parent's number, plus 1 for its second child.
    pub parent: u32,
    /// Upper corner of the second child.
    pub upper_1: [f32; 3],
    /// Zero, or undefined in a tree built on the device.
    pub spare: u32,
}

impl Node {
    /// A node without children.
    pub(crate) fn empty(parent: u32) -> Self {
        Self { child_0: BVH_NONE, child_1: BVH_NONE, parent, ..Self::zeroed() }
    }

    /// Sets one child, 0 or 1.
    pub(crate) fn set_child(&mut self, child: u32, reference: u32, [lower, upper]: [[f32; 3]; 2]) {
        if child == 0 {
            (self.child_0, self.lower_0, self.upper_0) = (reference, lower, upper);
        } else {
            (self.child_1, self.lower_1, self.upper_1) = (reference, lower, upper);
        }
    }

    /// Reference and box of both children.
    pub fn children(&self) -> [(u32, [[f32; 3]; 2]); 2] {
        [(self.child_0, [self.lower_0, self.upper_0]), (self.child_1, [self.lower_1, self.upper_1])]
    }
}

/// `BvhRecord`: a triangle in the order of the leaves.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Record {
    /// First corner, metres relative to the frame origin.
    pub a: [f32; 3],
    /// Second corner.
    pub b: [f32; 3],
    /// Third corner.
    pub c: [f32; 3],
    /// Global triangle id.
    pub primitive: u32,
}

impl Record {
    /// All corners.
    pub fn corners(&self) -> [[f32; 3]; 3] {
        [self.a, self.b, self.c]
    }
}

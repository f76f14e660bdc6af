//! The records that buffers of shaders hold, and their push constants, generated from the GLSL that declares them, with its comments and as it
//! lays them out: scalar block layout.
//!
//! `Default` is zeros, as in a buffer that was filled with them; a record of which zeros are no sensible value has none.

use bytemuck::{Pod, Zeroable};

use crate::constants::{bvh::BVH_NONE, contract::PRIMITIVE_NONE};

include!(concat!(env!("OUT_DIR"), "/records.rs"));

/// Records of the kernels that only tests use.
#[cfg(feature = "test-kernels")]
pub mod test_kernels {
    use bytemuck::{Pod, Zeroable};

    use super::RecordLayout;

    include!(concat!(env!("OUT_DIR"), "/test_records.rs"));
}

/// What Rust says of a record, as data. A test holds it against every compiled module that has the record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordLayout {
    /// Name in GLSL.
    pub name: &'static str,
    /// Bytes.
    pub size: usize,
    /// Members in order: name, offset in bytes, bytes.
    pub members: &'static [(&'static str, usize, usize)],
}

impl BvhNode {
    /// A node without children that is reached by a link.
    pub fn empty(parent: u32) -> Self {
        Self { child_0: BVH_NONE, child_1: BVH_NONE, parent, ..Self::zeroed() }
    }

    /// Sets reference and box of the first child (0), or else of the second.
    pub fn set_child(&mut self, child: u32, reference: u32, [lower, upper]: [[f32; 3]; 2]) {
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

impl BvhRecord {
    /// All corners.
    pub fn corners(&self) -> [[f32; 3]; 3] {
        [self.a, self.b, self.c]
    }
}

impl FilmPixel {
    /// Mean over the samples; black where there is none.
    pub fn mean(&self) -> [f32; 3] {
        if self.samples == 0 { [0.0; 3] } else { self.sum.map(|x| x / self.samples as f32) }
    }
}

impl Hit {
    /// Whether anything was hit.
    pub fn is_hit(&self) -> bool {
        self.primitive != PRIMITIVE_NONE
    }
}

impl Ray {
    /// A ray without limits, exclusion or cone.
    pub fn new(origin: [f32; 3], direction: [f32; 3]) -> Self {
        Self {
            origin,
            t_min: 0.0,
            direction,
            t_max: f32::INFINITY,
            exclude_primitive: PRIMITIVE_NONE,
            flags: 0,
            cone_width: 0.0,
            cone_spread: 0.0,
        }
    }
}

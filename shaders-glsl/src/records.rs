//! Records of the buffers of shaders, and their push constants, generated from the GLSL that declares them,
//! with its comments and in its layout: scalar block layout.
//!
//! `Default` is all zeros, as in a buffer that was filled with zeros; a record for which zeros are not a
//! sensible value has no `Default`.

use bytemuck::{Pod, Zeroable};

use crate::constants::bvh::BVH_NONE;
use crate::constants::contract::{PRIMITIVE_NONE, RAY_LIGHT_MOST, RAY_LIGHT_SHIFT};

include!(concat!(env!("OUT_DIR"), "/records.rs"));

/// Records of the kernels that only tests use.
#[cfg(feature = "test-kernels")]
pub mod test_kernels {
    use bytemuck::{Pod, Zeroable};

    use super::RecordLayout;

    include!(concat!(env!("OUT_DIR"), "/test_records.rs"));
}

/// Layout of a record in Rust, as data. A test compares it with every compiled module that has the record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordLayout {
    /// Name in GLSL.
    pub name: &'static str,
    /// Size in bytes.
    pub size: usize,
    /// Members in order: name, offset in bytes, size in bytes.
    pub members: &'static [(&'static str, usize, usize)],
}

impl BvhNode {
    /// Makes a node without children that is reached by a link.
    pub fn empty(parent: u32) -> Self {
        Self { child_0: BVH_NONE, child_1: BVH_NONE, parent, ..Self::zeroed() }
    }

    /// Sets reference and box of the first child (0), or of the second.
    pub fn set_child(&mut self, child: u32, reference: u32, [lower, upper]: [[f32; 3]; 2]) {
        if child == 0 {
            (self.child_0, self.lower_0, self.upper_0) = (reference, lower, upper);
        } else {
            (self.child_1, self.lower_1, self.upper_1) = (reference, lower, upper);
        }
    }

    /// Returns reference and box of both children.
    pub fn children(&self) -> [(u32, [[f32; 3]; 2]); 2] {
        [(self.child_0, [self.lower_0, self.upper_0]), (self.child_1, [self.lower_1, self.upper_1])]
    }
}

impl BvhNodeOfFour {
    /// Makes a node with these children, one to four, that is reached by a link: reference and box of each.
    pub fn new(parent: u32, children: &[(u32, [[f32; 3]; 2])]) -> Self {
        let mut node = Self { children: [BVH_NONE; 4], parent, ..Self::zeroed() };
        for slot in 0..4 {
            // The box of an absent child does not change a union.
            let (reference, bounds) = children.get(slot).copied().unwrap_or((BVH_NONE, children[0].1));
            node.children[slot] = reference;
            node.set_box(slot, bounds);
        }
        node
    }

    /// Sets the box of a child, 0 to 3.
    pub fn set_box(&mut self, slot: usize, [lower, upper]: [[f32; 3]; 2]) {
        let axes = [
            (&mut self.lower_x, &mut self.upper_x),
            (&mut self.lower_y, &mut self.upper_y),
            (&mut self.lower_z, &mut self.upper_z),
        ];
        for (axis, (lowers, uppers)) in axes.into_iter().enumerate() {
            (lowers[slot], uppers[slot]) = (lower[axis], upper[axis]);
        }
    }

    /// Returns number, reference and box of the existing children.
    pub fn children(&self) -> impl Iterator<Item = (u32, u32, [[f32; 3]; 2])> {
        let node = *self;
        (0..4_usize).filter(move |slot| node.children[*slot] != BVH_NONE).map(move |slot| {
            let lower = [node.lower_x[slot], node.lower_y[slot], node.lower_z[slot]];
            let upper = [node.upper_x[slot], node.upper_y[slot], node.upper_z[slot]];
            (slot as u32, node.children[slot], [lower, upper])
        })
    }
}

impl BvhRecord {
    /// Returns all corners.
    pub fn corners(&self) -> [[f32; 3]; 3] {
        [self.a, self.b, self.c]
    }
}

impl FilmPixel {
    /// Returns the mean over the samples; black without samples.
    pub fn mean(&self) -> [f32; 3] {
        if self.samples == 0 { [0.0; 3] } else { self.sum.map(|x| x / self.samples as f32) }
    }
}

impl Hit {
    /// True if anything was hit.
    pub fn is_hit(&self) -> bool {
        self.primitive != PRIMITIVE_NONE
    }
}

impl Ray {
    /// Makes a ray without limits, exclusion or cone.
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

    /// Makes this ray a shadow ray to the light of that number: lights without extent come first, then
    /// emitting triangles. A number beyond `RAY_LIGHT_MOST - 1` does not fit: the ray counts as one to a
    /// light without a map.
    #[must_use]
    pub fn with_light(self, light: u32) -> Self {
        let below = (1 << RAY_LIGHT_SHIFT) - 1;
        Self {
            flags: self.flags & below | light.saturating_add(1).min(RAY_LIGHT_MOST) << RAY_LIGHT_SHIFT,
            ..self
        }
    }

    /// Returns the number of the light that a shadow ray leads to, as of [`Ray::with_light`]; `None` for
    /// every other ray.
    pub fn light(&self) -> Option<u32> {
        (self.flags >> RAY_LIGHT_SHIFT).checked_sub(1)
    }
}

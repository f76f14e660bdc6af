//! Records of the buffers of shaders, and their push constants, generated from the GLSL that declares them,
//! with its comments and in its layout: scalar block layout.
//!
//! `Default` is all zeros, as in a buffer that was filled with zeros; a record for which zeros are not a
//! sensible value has no `Default`.

use bytemuck::{Pod, Zeroable};

use crate::constants::bvh::{BVH_NONE, BVH_STEPS};
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
    /// Makes a node with these children, two to four, that is reached by a link: reference and box of each.
    /// The boxes that [`BvhNodeOfFour::children`] returns contain these.
    ///
    /// # Panics
    /// There are fewer children, or more.
    pub fn new(parent: u32, children: &[(u32, [[f32; 3]; 2])]) -> Self {
        assert!((2..=4).contains(&children.len()), "{} children", children.len());
        let mut node = Self { children: [BVH_NONE; 4], parent, ..Self::zeroed() };
        for (place, (reference, _)) in node.children.iter_mut().zip(children) {
            *place = *reference;
        }
        // The box of an absent child does not change a union.
        let boxes: [_; 4] = std::array::from_fn(|slot| children.get(slot).unwrap_or(&children[0]).1);
        node.set_boxes(boxes);
        node
    }

    /// Sets the boxes of all children.
    fn set_boxes(&mut self, boxes: [[[f32; 3]; 2]; 4]) {
        self.steps = 0;
        for axis in 0..3 {
            let sides = |corner: usize| boxes.map(|bounds| bounds[corner][axis]);
            let lower = sides(0).map(|side| if side.is_finite() { side } else { f32::MIN });
            let upper = sides(1).map(|side| if side.is_finite() { side } else { f32::MAX });
            let origin = lower.into_iter().fold(f32::INFINITY, f32::min);
            let exponent = step_exponent(origin, upper.into_iter().fold(f32::NEG_INFINITY, f32::max));
            let size = f32::from_bits(exponent << 23);
            let bytes = |numbers: [u8; 4]| u32::from_le_bytes(numbers);
            self.origin[axis] = origin;
            self.steps |= exponent << (8 * axis);
            *self.sides_mut(axis) = [
                bytes(lower.map(|side| steps_below(side, origin, size))),
                bytes(upper.map(|side| steps_above(side, origin, size))),
            ];
        }
    }

    /// Returns number, reference and stored box of the existing children.
    pub fn children(&self) -> impl Iterator<Item = (u32, u32, [[f32; 3]; 2])> {
        let node = *self;
        let side = move |slot: usize, corner: usize| -> [f32; 3] {
            std::array::from_fn(|axis| {
                let number = node.sides(axis)[corner].to_le_bytes()[slot];
                side_of(number, node.origin[axis], node.step_sizes()[axis])
            })
        };
        (0..4_usize)
            .filter(move |slot| node.children[*slot] != BVH_NONE)
            .map(move |slot| (slot as u32, node.children[slot], [side(slot, 0), side(slot, 1)]))
    }

    /// Returns the sizes of a step along the axes, metres.
    pub fn step_sizes(&self) -> [f32; 3] {
        std::array::from_fn(|axis| f32::from_bits((self.steps >> (8 * axis) & 0xFF) << 23))
    }

    fn sides(&self, axis: usize) -> [u32; 2] {
        [self.x, self.y, self.z][axis]
    }

    fn sides_mut(&mut self, axis: usize) -> &mut [u32; 2] {
        [&mut self.x, &mut self.y, &mut self.z][axis]
    }
}

// The arithmetic of `bvh/steps.glsl`.

fn side_of(number: u8, origin: f32, size: f32) -> f32 {
    origin + f32::from(number) * size
}

/// Returns the exponent of the smallest step of which `BVH_STEPS` lead from one side to another, or beyond.
fn step_exponent(origin: f32, end: f32) -> u32 {
    let bits = ((end - origin) / BVH_STEPS as f32).to_bits();
    let exponent = ((bits + 0x7F_FFFF) >> 23).clamp(1, 254);
    let reaches = side_of(u8::MAX, origin, f32::from_bits(exponent << 23)) >= end;
    if reaches { exponent } else { (exponent + 1).min(254) }
}

/// Returns the largest number of steps that does not lead beyond a side; 0 where the distance overflows.
fn steps_below(side: f32, origin: f32, size: f32) -> u8 {
    // A number beyond the range of the type becomes its nearest.
    let number = ((side - origin) / size).floor() as u8;
    let number = if side_of(number, origin, size) > side { number.saturating_sub(1) } else { number };
    if side_of(number, origin, size) > side { 0 } else { number }
}

/// Returns the smallest number of steps that leads to a side, or beyond.
fn steps_above(side: f32, origin: f32, size: f32) -> u8 {
    let number = ((side - origin) / size).ceil() as u8;
    let number = if side_of(number, origin, size) < side { number.saturating_add(1) } else { number };
    if side_of(number, origin, size) < side { u8::MAX } else { number }
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

#[cfg(test)]
mod tests {
    use super::*;

    type Box3 = [[f32; 3]; 2];

    /// Checks that the stored boxes contain these, and returns the greatest number of steps by which a side
    /// lies farther out, apart from a unit of rounding.
    fn steps_beyond(boxes: [Box3; 4]) -> f64 {
        let children = boxes.map(|bounds| (7, bounds));
        let node = BvhNodeOfFour::new(3, &children);
        assert_eq!((node.parent, node.children), (3, [7; 4]));
        let mut most = 0.0_f64;
        for ((slot, reference, [lower, upper]), exact) in node.children().zip(boxes) {
            assert_eq!(reference, 7);
            for axis in 0..3 {
                let exact = [exact[0][axis], exact[1][axis]];
                assert!(
                    lower[axis] <= exact[0] && upper[axis] >= exact[1],
                    "{slot}, {axis}: {lower:?} {upper:?} {exact:?}"
                );
                let far = [
                    f64::from(exact[0]) - f64::from(lower[axis]),
                    f64::from(upper[axis]) - f64::from(exact[1]),
                ];
                let step = f64::from(node.step_sizes()[axis]);
                let end = boxes.iter().fold(f32::NEG_INFINITY, |end, bounds| end.max(bounds[1][axis]));
                let half = side_of(u8::MAX, node.origin[axis], 0.5 * node.step_sizes()[axis]);
                // A step is the smallest that leads to the end, up to rounding of the end.
                let is_least = half <= end.next_up() || node.step_sizes()[axis] == f32::MIN_POSITIVE;
                assert!(is_least, "{axis}: {node:?} {boxes:?}");
                let unit = f64::from(f32::EPSILON) * f64::from(exact[0].abs().max(exact[1].abs()));
                most = far.into_iter().fold(most, |most, far| most.max((far - unit) / step));
            }
        }
        most
    }

    /// Returns numbers from 0 to 1, always the same.
    fn numbers() -> impl FnMut() -> f32 {
        let mut state = 1_u64;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / (1 << 24) as f32
        }
    }

    #[test]
    fn stored_boxes_contain_the_exact_ones_and_are_a_step_larger_at_most() {
        let mut number = numbers();
        for (scale, place) in
            [(1.0, 0.0), (1.0, 1.0e3), (1.0e-6, 1.0), (1.0e30, 0.0), (1.0e-42, 0.0), (1.0e-7, 1.0e4)]
        {
            for _ in 0..2_000 {
                let boxes = std::array::from_fn(|_| {
                    let lower: [f32; 3] = std::array::from_fn(|_| place + scale * (number() - 0.5));
                    [lower, lower.map(|side| side + scale * number() * number())]
                });
                let beyond = steps_beyond(boxes);
                assert!(beyond <= 1.001, "{scale}, {place}: {beyond} {boxes:?}");
            }
        }
    }

    #[test]
    fn boxes_without_extent_are_stored_exactly() {
        for place in [0.0, -0.0, 0.1, -7.5e8, 1.0e-40, f32::MIN_POSITIVE, f32::MAX, f32::MIN] {
            let node = BvhNodeOfFour::new(0, &[(1, [[place; 3]; 2]); 4]);
            assert!(node.children().all(|(.., bounds)| bounds == [[place; 3]; 2]), "{place}");
        }
    }

    /// The other boxes of the node are large then, and no side is NaN.
    #[test]
    fn sides_that_are_not_finite_leave_boxes_that_contain_all() {
        let small = [[0.25; 3], [0.5; 3]];
        let (infinite, nan) = (f32::INFINITY, f32::NAN);
        for odd in [
            [[nan; 3]; 2],
            [[-infinite; 3], [infinite; 3]],
            [[infinite; 3]; 2],
            [[-infinite; 3]; 2],
            [[f32::MIN; 3], [f32::MAX; 3]],
            [[nan; 3], [1.0; 3]],
            [[-3.4e38; 3], [-3.3e38; 3]],
            [[3.0e38; 3], [3.1e38; 3]],
        ] {
            let node = BvhNodeOfFour::new(0, &[(1, small), (2, odd), (3, [[3.0e38; 3]; 2]), (4, small)]);
            for (_, reference, [lower, upper]) in node.children() {
                assert!(lower.iter().chain(&upper).all(|side| !side.is_nan()), "{odd:?}");
                let exact = [small, odd, [[3.0e38; 3]; 2], small][reference as usize - 1];
                let exact = exact.map(|corner| corner.map(|side| side.clamp(f32::MIN, f32::MAX)));
                let is_within = (0..3).all(|axis| {
                    let contains = |side: f32| side.is_nan() || (lower[axis]..=upper[axis]).contains(&side);
                    contains(exact[0][axis]) && contains(exact[1][axis])
                });
                assert!(is_within, "{odd:?}: {lower:?} {upper:?}");
            }
        }
    }
}

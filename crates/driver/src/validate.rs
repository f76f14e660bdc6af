//! Checks of the boxes of a built tree. Nobody but the driver can read the tree that it made of the boxes.

use rasray_shaders_glsl::constants::driver::DRIVER_BOX_WORDS;

use crate::Header;

/// Downloaded contents of all pools, in words.
#[derive(Clone, Debug)]
pub struct Contents {
    /// Header after the build.
    pub header: Header,
    /// Lower and upper corner of each triangle's box.
    pub boxes: Vec<u32>,
}

/// Fault in a box.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// Box of a triangle that has no inside, or reaches beyond the bounds that the header promises.
    #[error("the box of triangle {primitive} is {stored}")]
    Box {
        /// Index of the triangle.
        primitive: usize,
        /// Corners of the box.
        stored: String,
    },
    /// Number of boxes that is smaller than that of triangles.
    #[error("{triangles} triangles have {boxes} boxes")]
    Count {
        /// Number of triangles of the geometry.
        triangles: usize,
        /// Number of boxes in the pool.
        boxes: usize,
    },
}

/// Maximum coordinate of a box, in the units of the header: bounds are within two units of their centre, and
/// margins are a small share of that.
const FARTHEST: f32 = 2.1;

/// Checks that each of `triangles` triangles has a box that has an inside and lies within the bounds.
///
/// # Errors
/// The first fault found.
pub fn well_formed(contents: &Contents, triangles: u32) -> Result<(), Fault> {
    let triangles = triangles as usize;
    let corners: Vec<[f32; 6]> = contents
        .boxes
        .chunks_exact(DRIVER_BOX_WORDS as usize)
        .map(|words| std::array::from_fn(|at| f32::from_bits(words[at])))
        .collect();
    let of_triangles = corners.get(..triangles).ok_or(Fault::Count { triangles, boxes: corners.len() })?;
    let is_box = |corners: &[f32; 6]| {
        (0..3).all(|axis| corners[axis] < corners[axis + 3]) && corners.iter().all(|x| x.abs() <= FARTHEST)
    };
    match of_triangles.iter().position(|corners| !is_box(corners)) {
        Some(primitive) => Err(Fault::Box { primitive, stored: format!("{:?}", of_triangles[primitive]) }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fault_is_found() {
        let fault = |corners: [f32; 6], triangles| {
            let boxes = corners.map(f32::to_bits).to_vec();
            well_formed(&Contents { header: Header::default(), boxes }, triangles).err()
        };
        let sound = [-1.0, -1.0, 0.0, 1.0, -0.5, 0.5];
        assert_eq!(fault(sound, 1), None);
        assert_eq!(fault(sound, 2), Some(Fault::Count { triangles: 2, boxes: 1 }));
        for (at, wrong) in [(0, 1.0), (4, -1.0), (5, 3.0), (2, f32::NAN)] {
            let mut corners = sound;
            corners[at] = wrong;
            assert!(matches!(fault(corners, 1), Some(Fault::Box { primitive: 0, .. })), "{corners:?}");
        }
    }
}

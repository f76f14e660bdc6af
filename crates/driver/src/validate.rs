//! Checks the boxes of a built tree. What the driver made of them nobody else can read.

use rasray_shaders_glsl::constants::driver::DRIVER_BOX_WORDS;

use crate::Header;

/// All pools as downloaded, in words.
#[derive(Clone, Debug)]
pub struct Contents {
    /// The header.
    pub header: Header,
    /// Lower and upper corner of each triangle's box.
    pub boxes: Vec<u32>,
}

/// Fault of a box.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// The box of a triangle has no inside, or reaches beyond the units that the header promises.
    #[error("the box of triangle {primitive} is {stored}")]
    Box {
        /// The triangle.
        primitive: usize,
        /// Its corners.
        stored: String,
    },
    /// There are fewer boxes than triangles.
    #[error("{triangles} triangles have {boxes} boxes")]
    Count {
        /// Triangles of the geometry.
        triangles: usize,
        /// Boxes in the pool.
        boxes: usize,
    },
}

/// Largest coordinate of a box: the bounds are within two units of their centre, and margins are a small
/// share of that.
const FARTHEST: f32 = 2.1;

/// Checks that each of `triangles` triangles has a box with an inside within the bounds.
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

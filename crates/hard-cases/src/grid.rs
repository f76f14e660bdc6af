use super::case::Triangle;

/// Voxels for which a case is made: cubes of one size, equally many along each axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Lowest corner, metres.
    pub low: [f32; 3],
    /// Side of a voxel, metres.
    pub cell: f32,
    /// Number of voxels along each axis.
    pub resolution: u32,
}

impl Grid {
    /// Grid of 64 voxels of one metre along each axis, from the origin.
    pub const UNIT_64: Self = Self { low: [0.0; 3], cell: 1.0, resolution: 64 };

    /// Returns the highest corner, metres.
    pub fn high(&self) -> [f32; 3] {
        self.low.map(|low| low + self.cell * self.resolution as f32)
    }

    /// Makes a small triangle in each face of the grid, so that the bounds of the scene are the grid's. The
    /// triangles lie away from edges, diagonals and middle planes of the grid, along which the cases' rays
    /// run.
    pub(super) fn markers(&self) -> [Triangle; 6] {
        std::array::from_fn(|face| {
            let axis = face / 2;
            let place = |u: f32, v: f32| {
                let mut point = if face % 2 == 0 { self.low } else { self.high() };
                point[(axis + 1) % 3] = self.low[(axis + 1) % 3] + self.cell * u;
                point[(axis + 2) % 3] = self.low[(axis + 2) % 3] + self.cell * v;
                point
            };
            [place(50.0, 20.0), place(50.25, 20.0), place(50.0, 20.25)]
        })
    }
}

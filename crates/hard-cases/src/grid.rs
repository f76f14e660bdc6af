use super::case::Triangle;

/// The voxels that a case is made for: cubes of one size, equally many along each axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Lowest corner, metres.
    pub low: [f32; 3],
    /// Side of a voxel, metres.
    pub cell: f32,
    /// Voxels along each axis.
    pub resolution: u32,
}

impl Grid {
    /// 64 voxels of one metre along each axis, from the origin.
    pub const UNIT_64: Self = Self { low: [0.0; 3], cell: 1.0, resolution: 64 };

    /// Highest corner, metres.
    pub fn high(&self) -> [f32; 3] {
        self.low.map(|low| low + self.cell * self.resolution as f32)
    }

    /// A small triangle in each face of the grid, so that the bounds of the scene are the grid's. They lie
    /// away from edges, diagonals and middle planes of the grid, which the cases' rays run along.
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

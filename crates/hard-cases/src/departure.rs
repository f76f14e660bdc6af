use super::case::Triangle;

/// Point inside a triangle as renderers compute it, moved outwards by the bound of its rounding.
pub(super) struct Departure {
    pub origin: [f32; 3],
    /// Unit normal on the counter-clockwise side.
    pub normal: [f64; 3],
}

impl Departure {
    /// Makes the departure from the point of a triangle with these weights, on its counter-clockwise side.
    pub fn new(triangle: &Triangle, weights: [f32; 3]) -> Self {
        // The bound counts seven roundings: of three products and two sums, and of the weights themselves.
        let gamma = 7.0 * 2.0_f64.powi(-24);
        let point: [f32; 3] =
            std::array::from_fn(|axis| (0..3).map(|i| weights[i] * triangle[i][axis]).sum());
        let bound: f64 = (0..3)
            .map(|axis| (0..3).map(|i| f64::from((weights[i] * triangle[i][axis]).abs())).sum::<f64>())
            .fold(0.0, f64::max)
            * gamma;
        let edge = |to: usize| -> [f64; 3] {
            std::array::from_fn(|axis| f64::from(triangle[to][axis]) - f64::from(triangle[0][axis]))
        };
        let (u, v) = (edge(1), edge(2));
        let cross: [f64; 3] =
            std::array::from_fn(|a| u[(a + 1) % 3] * v[(a + 2) % 3] - u[(a + 2) % 3] * v[(a + 1) % 3]);
        let length = cross.iter().map(|x| x * x).sum::<f64>().sqrt();
        let normal = cross.map(|x| x / length);
        let distance = bound * normal.iter().map(|x| x.abs()).sum::<f64>();
        let origin = std::array::from_fn(|axis| {
            let moved = (f64::from(point[axis]) + normal[axis] * distance) as f32;
            // The point moves one more step outwards, so that rounding does not undo the move.
            if normal[axis] > 0.0 {
                moved.next_up()
            } else if normal[axis] < 0.0 {
                moved.next_down()
            } else {
                moved
            }
        });
        Self { origin, normal }
    }

    /// Returns a direction on the side of the departure, which leans towards the normal by `lean` so that
    /// neighbours whose corners are rounded stay behind.
    pub fn away(&self, direction: [f32; 3], lean: f32) -> [f32; 3] {
        let cosine: f64 = self.normal.iter().zip(direction).map(|(n, d)| n * f64::from(d)).sum();
        let side = if cosine < 0.0 { -1.0 } else { 1.0 };
        std::array::from_fn(|axis| side * direction[axis] + lean * self.normal[axis] as f32)
    }
}

//! Which triangles move, and where all others are.

use std::ops::Range;

use crate::Posed;

/// Triangles that move.
#[derive(Clone, Debug)]
pub struct MovingTriangles {
    /// Their ids: in order, no range empty, none that touch.
    pub ids: Vec<Range<u32>>,
    /// Corners of the bounds of all others, and of these at rest, metres relative to the frame origin; those of all where
    /// there are none.
    pub bounds: [[[f32; 3]; 2]; 2],
}

impl MovingTriangles {
    /// Those of the draws that move.
    pub fn of(posed: &Posed, moving_draws: &[bool]) -> Self {
        let mut ids: Vec<Range<u32>> = Vec::new();
        let empty = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
        let mut bounds = [empty; 2];
        for (draw, &moves) in posed.draws.iter().zip(moving_draws) {
            let end = draw.first_triangle + draw.triangle_count;
            match ids.last_mut() {
                _ if !moves => {}
                Some(last) if last.end == draw.first_triangle => last.end = end,
                _ => ids.push(draw.first_triangle..end),
            }
            let [lower, upper] = &mut bounds[usize::from(moves)];
            for &index in &posed.indices[3 * draw.first_triangle as usize..3 * end as usize] {
                let position = posed.positions[index as usize];
                for axis in 0..3 {
                    lower[axis] = lower[axis].min(position[axis]);
                    upper[axis] = upper[axis].max(position[axis]);
                }
            }
        }
        let whole = [posed.lower, posed.upper];
        Self { ids, bounds: bounds.map(|bounds| if bounds == empty { whole } else { bounds }) }
    }
}

//! Moving triangles, the parts in which they move, and the static triangles.

use std::collections::BTreeMap;
use std::ops::Range;

use rasray_ads::MovingPart;

use super::sources::DrawPlace;
use crate::Posed;

const EMPTY: [[f32; 3]; 2] = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];

/// Triangles of a draw.
#[derive(Clone, Debug)]
pub struct DrawTriangles {
    ids: Range<u32>,
    /// Bounds at rest; empty without triangles.
    bounds: [[f32; 3]; 2],
}

impl DrawTriangles {
    /// Returns the triangles of all draws, in the order of their ids.
    pub fn all(posed: &Posed) -> Vec<Self> {
        let of = |first: u32, count: u32| {
            let ids = first..first + count;
            let mut bounds = EMPTY;
            for &index in &posed.indices[3 * ids.start as usize..3 * ids.end as usize] {
                let position = posed.positions[index as usize];
                bounds = united(bounds, [position; 2]);
            }
            Self { ids, bounds }
        };
        posed.draws.iter().map(|draw| of(draw.first_triangle, draw.triangle_count)).collect()
    }
}

/// Moving triangles, in parts that may move apart from each other.
#[derive(Clone, Debug)]
pub struct MovingTriangles {
    /// Parts, at least one; if nothing moves, the one part has no triangles. Each has bounds at rest, metres
    /// relative to the frame origin; a part without triangles has those of all triangles. Ids are in order;
    /// no range is empty, and no two ranges touch.
    pub parts: Vec<MovingPart>,
    /// Bounds of all static triangles; of all triangles if there are none.
    pub static_bounds: [[f32; 3]; 2],
    /// Index of each moving draw's part, in the order of the pose's draws.
    pub part_of: Vec<usize>,
    /// Carrier node of each of the first parts; the other parts are moved by more than one node.
    pub carriers: Vec<usize>,
}

impl MovingTriangles {
    /// Puts all moving triangles into one part.
    pub fn together(draws: &[DrawTriangles], places: &[DrawPlace]) -> Self {
        Self::divided(draws, places, vec![0; places.len()], Vec::new())
    }

    /// Makes a part for each object that its node alone moves: all draws that the same node carries. The
    /// `most` largest objects have parts, the largest first; one more part, the last, has all others and all
    /// that deforms.
    pub fn objects(draws: &[DrawTriangles], places: &[DrawPlace], most: usize) -> Self {
        let mut sizes: BTreeMap<usize, usize> = BTreeMap::new();
        for place in places {
            if let Some(carrier) = place.carrier {
                *sizes.entry(carrier).or_default() += draws[place.draw].ids.len();
            }
        }
        let mut carriers: Vec<(usize, usize)> = sizes.into_iter().collect();
        carriers.sort_by_key(|&(_, triangles)| std::cmp::Reverse(triangles));
        carriers.truncate(most);
        let own = |place: &DrawPlace| {
            let found = carriers.iter().position(|&(carrier, _)| Some(carrier) == place.carrier);
            found.unwrap_or(carriers.len())
        };
        let part_of = places.iter().map(own).collect();
        Self::divided(draws, places, part_of, carriers.into_iter().map(|(carrier, _)| carrier).collect())
    }

    /// Divides the moving draws into the given parts.
    fn divided(
        draws: &[DrawTriangles],
        places: &[DrawPlace],
        part_of: Vec<usize>,
        carriers: Vec<usize>,
    ) -> Self {
        let count = part_of.iter().max().map_or(1, |last| last + 1);
        let mut ids = vec![Vec::<Range<u32>>::new(); count];
        // The static part is the last one here.
        let mut bounds = vec![EMPTY; count + 1];
        let mut moving = places.iter().zip(&part_of).peekable();
        for (number, draw) in draws.iter().enumerate() {
            let part = moving.next_if(|(place, _)| place.draw == number).map_or(count, |(_, part)| *part);
            bounds[part] = united(bounds[part], draw.bounds);
            let Some(ids) = ids.get_mut(part) else { continue };
            match ids.last_mut() {
                _ if draw.ids.is_empty() => {}
                Some(last) if last.end == draw.ids.start => last.end = draw.ids.end,
                _ => ids.push(draw.ids.clone()),
            }
        }
        let whole = bounds.iter().copied().fold(EMPTY, united);
        let stated = |bounds: [[f32; 3]; 2]| match (bounds == EMPTY, whole == EMPTY) {
            (false, _) => bounds,
            (true, false) => whole,
            (true, true) => [[0.0; 3]; 2],
        };
        let static_bounds = stated(bounds[count]);
        let parts = ids.into_iter().zip(bounds).map(|(ids, bounds)| MovingPart {
            ids,
            bounds: stated(bounds),
            rest: None,
        });
        Self { parts: parts.collect(), static_bounds, part_of, carriers }
    }
}

fn united(one: [[f32; 3]; 2], other: [[f32; 3]; 2]) -> [[f32; 3]; 2] {
    let each = |corner: usize, with: fn(f32, f32) -> f32| -> [f32; 3] {
        std::array::from_fn(|axis| with(one[corner][axis], other[corner][axis]))
    };
    [each(0, f32::min), each(1, f32::max)]
}

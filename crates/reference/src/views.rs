//! Cells of a cube of views that a ray crosses, in double precision, computed directly from their definition.

use std::cmp::Ordering;

/// Segment of a ray within one cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellChord {
    /// View, 0 to 5: along axis `view / 2`, towards positive values if it is even.
    pub view: u32,
    /// Column and row, from 0 to the resolution less 1.
    pub cell: [u32; 2],
    /// Ray parameters of entry and exit, in units of the direction's length.
    pub t: [f64; 2],
}

impl std::fmt::Display for CellChord {
    /// Writes one line.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { view, cell: [x, y], t: [t_in, t_out] } = self;
        write!(f, "cell ({x}, {y}) of view {view}, t {t_in} to {t_out}")
    }
}

/// Returns the cells in the order in which the ray crosses them for `range[0] < t < range[1]`. The origin is
/// relative to the eye, in metres; the direction need not be unit; the resolution is the number of cells
/// along a side. A ray along a boundary belongs to the cell above it. Empty for a direction of zero.
pub fn cells_along(
    origin: [f64; 3],
    direction: [f64; 3],
    range: [f64; 2],
    resolution: u32,
) -> Vec<CellChord> {
    let mut chords = Vec::new();
    if direction == [0.0; 3] || resolution == 0 {
        return chords;
    }
    let side = f64::from(resolution);
    for view in 0..6 {
        let (o, d) = (in_view(origin, view), in_view(direction, view));
        // The view is the pyramid |x| <= z, |y| <= z.
        let mut interval = range;
        for axis in 0..2 {
            for sign in [1.0, -1.0] {
                interval = clip(interval, o[2] + sign * o[axis], d[2] + sign * d[axis]);
            }
        }
        let [begin, end] = interval;
        if begin.partial_cmp(&end) != Some(Ordering::Less) {
            continue;
        }
        let mut crossings = vec![begin, end];
        for axis in 0..2 {
            for boundary in 1..resolution {
                let c = 2.0 * f64::from(boundary) / side - 1.0;
                let t = (c * o[2] - o[axis]) / (d[axis] - c * d[2]);
                if begin < t && t < end {
                    crossings.push(t);
                }
            }
        }
        crossings.sort_unstable_by(f64::total_cmp);
        for pair in crossings.windows(2) {
            let [t_in, t_out] = [pair[0], pair[1]];
            if t_in.partial_cmp(&t_out) != Some(Ordering::Less) {
                continue;
            }
            let t = if t_out.is_finite() { 0.5 * (t_in + t_out) } else { 2.0 * t_in.abs() + 1.0e6 };
            let p: [f64; 3] = std::array::from_fn(|axis| o[axis] + t * d[axis]);
            let place = |x: f64| (((x / p[2] + 1.0) * 0.5 * side).max(0.0) as u32).min(resolution - 1);
            chords.push(CellChord { view, cell: [place(p[0]), place(p[1])], t: [t_in, t_out] });
        }
    }
    chords.sort_by(|a, b| a.t[0].total_cmp(&b.t[0]));
    chords
}

/// Returns a vector as a view sees it: a permutation and a change of sign.
fn in_view(p: [f64; 3], view: u32) -> [f64; 3] {
    let [x, y, z] = match view / 2 {
        0 => [p[1], p[2], p[0]],
        1 => [p[2], p[0], p[1]],
        _ => p,
    };
    [x, y, if view % 2 == 1 { -z } else { z }]
}

/// Returns the part of a range where `at_zero + t slope >= 0`; empty if its ends are out of order.
fn clip([low, high]: [f64; 2], at_zero: f64, slope: f64) -> [f64; 2] {
    if slope == 0.0 {
        return if at_zero >= 0.0 { [low, high] } else { [1.0, 0.0] };
    }
    let t = -at_zero / slope;
    if slope > 0.0 { [low.max(t), high] } else { [low, high.min(t)] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_across_one_view_crosses_every_column_once() {
        let chords = cells_along([-2.0, 0.1, 2.0], [1.0, 0.0, 0.0], [0.0, 4.0], 8);
        let cells: Vec<_> = chords.iter().map(|chord| (chord.view, chord.cell)).collect();
        let expected: Vec<_> = (0..8).map(|x| (4, [x, 4])).collect();
        assert_eq!(cells, expected);
        for (index, chord) in chords.iter().enumerate() {
            assert_eq!(chord.t, [0.5 * index as f64, 0.5 * (index + 1) as f64]);
        }
    }

    #[test]
    fn intervals_join_without_gap_from_view_to_view() {
        let (origin, direction) = ([0.3, -2.0, 1.7], [0.4, 1.0, -0.9]);
        let chords = cells_along(origin, direction, [0.0, 1.0e4], 16);
        assert_eq!((chords[0].t[0], chords[chords.len() - 1].t[1]), (0.0, 1.0e4));
        let views: std::collections::BTreeSet<u32> = chords.iter().map(|chord| chord.view).collect();
        assert!(views.len() >= 3, "{views:?}");
        for pair in chords.windows(2) {
            assert!((pair[0].t[1] - pair[1].t[0]).abs() < 1e-9, "{} then {}", pair[0], pair[1]);
        }
        // A missing chord is a gap.
        let mut gap = chords.clone();
        gap.remove(3);
        assert!(gap.windows(2).any(|pair| (pair[0].t[1] - pair[1].t[0]).abs() > 1e-9));
    }

    #[test]
    fn a_ray_through_the_eye_and_a_ray_without_direction() {
        let chords = cells_along([0.0; 3], [1.0, 2.0, 3.0], [0.0, f64::INFINITY], 4);
        assert_eq!(chords, [CellChord { view: 4, cell: [2, 3], t: [0.0, f64::INFINITY] }]);
        assert!(cells_along([1.0; 3], [0.0; 3], [0.0, 1.0], 4).is_empty());
    }
}

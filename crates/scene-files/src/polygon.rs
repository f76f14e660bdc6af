//! Division of polygons into triangles.
//!
//! A polygon that a fan from its first corner fills becomes that fan: every convex polygon does, and each
//! concave one whose first corner sees all others. Any other polygon is cut along its ears in the plane of
//! its normal (Newell's, the sum of the fan's), by the crate `earcut`. A polygon of n corners becomes n - 2
//! triangles in either case, and every corner is a corner of a triangle, so that polygons that share corners
//! stay closed. Triangles keep the side that the polygon faces.

use std::collections::HashMap;

use earcut::Earcut;
use glam::{DVec2, DVec3};

/// Division of a polygon into triangles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Filling {
    /// Fan from the first corner.
    Fan,
    /// These triangles, as indices of the polygon's corners; there are two fewer than corners.
    Cut(Vec<[u32; 3]>),
    /// The polygon's sides cross, or it is too large to be cut: no triangles fill it for certain, and a fan
    /// shows it.
    Crossing,
}

/// Remark on faces that are [`Filling::Crossing`], after their number.
pub(crate) const CROSSING: &str =
    "faces have sides that cross, or too many corners; they are shown as fans from their first corner";

/// Sine of the angle by which a fan may turn back without counting as concave: rounding of single-precision
/// positions.
const ROUNDING: f64 = 1.0e-7;

/// Number of corners of the largest polygon that is cut. The time grows with the square in the worst case.
const MOST: usize = 1 << 15;

/// Divider of polygons, one after the other, that keeps its memory between them.
#[derive(Default)]
pub(crate) struct Polygons {
    earcut: Earcut<f64>,
    flat: Vec<[f64; 2]>,
    cut: Vec<u32>,
}

impl Polygons {
    /// Divides a polygon with these corners, in order.
    pub fn fill(&mut self, corners: &[DVec3]) -> Filling {
        let Some((&first, rest)) = corners.split_first() else { return Filling::Fan };
        if rest.len() < 3 || !corners.iter().all(|corner| corner.is_finite()) {
            return Filling::Fan;
        }
        // Coordinates are relative to the first corner: far from the origin, products of coordinates have no
        // bits left for a polygon.
        let from_first = || rest.iter().map(|corner| *corner - first);
        let normal: DVec3 = from_first().zip(from_first().skip(1)).map(|(a, b)| a.cross(b)).sum();
        let size = from_first().map(|side| side.abs().max_element()).fold(0.0, f64::max);
        let steepest = normal.abs().max_position();
        // Cross products this small may be rounding alone.
        if normal[steepest].abs() <= 1.0e-14 * size * size {
            let is_line = from_first().zip(from_first().skip(1)).all(|(a, b)| is_line(a, b));
            return if is_line { Filling::Fan } else { Filling::Crossing };
        }
        // The projection along the steepest axis rounds no coordinate; the view is from the side on which
        // corners run to the left.
        let (u, v) = ((steepest + 1) % 3, (steepest + 2) % 3);
        let (u, v) = if normal[steepest] > 0.0 { (u, v) } else { (v, u) };
        self.flat.clear();
        self.flat.push([0.0; 2]);
        self.flat.extend(from_first().map(|corner| [corner[u], corner[v]]));
        if is_fan(&self.flat) {
            return Filling::Fan;
        }
        if corners.len() > MOST {
            return Filling::Crossing;
        }
        self.earcut.earcut_slice(&self.flat, &[], &mut self.cut);
        whole(&self.flat, &self.cut).map_or(Filling::Crossing, Filling::Cut)
    }
}

/// True if two vectors from one point lie on a line.
fn is_line(a: DVec3, b: DVec3) -> bool {
    a.cross(b).length() <= ROUNDING * a.length() * b.length()
}

/// True if a fan from the first corner, which is zero, fills a polygon that runs to the left.
fn is_fan(flat: &[[f64; 2]]) -> bool {
    let mut was_right = false;
    flat[1..].windows(2).all(|pair| {
        let [a, b] = [pair[0], pair[1]].map(DVec2::from);
        let turns_left = a.perp_dot(b) >= -ROUNDING * a.length() * b.length();
        // The corners run once around the first one: after passing to the right of the first side, they may
        // not come back to its left.
        let side = DVec2::from(flat[1]).perp_dot(b);
        let comes_back = was_right && side > 0.0;
        was_right |= side < 0.0;
        turns_left && !comes_back
    })
}

/// Returns triangles that use every corner and fill the polygon, made from those that `earcut` found, which
/// leaves out corners that lie on a line with their neighbours. `None` if the triangles fill another area:
/// their areas must be positive and add up to that of the polygon, so that each point is covered as often as
/// the polygon runs around it.
fn whole(flat: &[[f64; 2]], cut: &[u32]) -> Option<Vec<[u32; 3]>> {
    let point = |corner: u32| DVec2::from(flat[corner as usize]);
    let twice = |[a, b, c]: [u32; 3]| (point(b) - point(a)).perp_dot(point(c) - point(a));
    let count = flat.len() as u32;
    let mut triangles: Vec<[u32; 3]> = Vec::with_capacity(flat.len() - 2);
    for corners in cut.chunks_exact(3) {
        let triangle = [corners[0], corners[1], corners[2]];
        triangles.push(if twice(triangle) < 0.0 {
            [triangle[0], triangle[2], triangle[1]]
        } else {
            triangle
        });
    }
    // The triangle at each side, and the corner opposite the side.
    let mut sides: HashMap<(u32, u32), usize> = HashMap::with_capacity(3 * triangles.len());
    let mut is_used = vec![false; flat.len()];
    for (number, [a, b, c]) in triangles.iter().copied().enumerate() {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            sides.insert((from, to), number);
            is_used[from as usize] = true;
        }
    }
    let first = is_used.iter().position(|used| *used)? as u32;
    let (mut from, mut skipped) = (first, Vec::new());
    for step in 1..=count {
        let to = (first + step) % count;
        if !is_used[to as usize] {
            skipped.push(to);
            continue;
        }
        if !skipped.is_empty() {
            let number = *sides.get(&(from, to))?;
            let apex = *triangles[number].iter().find(|corner| **corner != from && **corner != to)?;
            // Corners that follow one another on the side divide its triangle; a spike has no area.
            let side = point(to) - point(from);
            let length = side.length();
            let along = side / length;
            let (mut last, mut reach, mut place) = (from, 0.0, number);
            for corner in skipped.drain(..) {
                let way = point(corner) - point(from);
                let (at, beside) = (way.dot(along), way.perp_dot(along));
                if !(reach..=length).contains(&at) || beside.abs() > ROUNDING * length {
                    triangles.push([last, corner, corner]);
                    continue;
                }
                triangles[place] = [last, corner, apex];
                sides.insert((last, corner), place);
                if last == from {
                    sides.insert((apex, from), place);
                }
                place = triangles.len();
                triangles.push([corner, to, apex]);
                (last, reach) = (corner, at);
            }
            sides.insert((last, to), place);
            sides.insert((to, apex), place);
        }
        from = to;
    }
    let filled: f64 = triangles.iter().map(|triangle| twice(*triangle)).sum();
    let covered: f64 = triangles.iter().map(|triangle| twice(*triangle).abs()).sum();
    let area: f64 = (1..count - 1).map(|corner| twice([0, corner, corner + 1])).sum();
    let agrees = |found: f64| (found - area).abs() <= 1.0e-9 * area.abs();
    (triangles.len() + 2 == flat.len() && agrees(filled) && agrees(covered)).then_some(triangles)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn lifted(flat: &[[f64; 2]]) -> Vec<DVec3> {
        // The plane is slanted and far away.
        flat.iter().map(|[x, y]| DVec3::new(*x, *y, 0.5 * x - 0.25 * y) + DVec3::splat(4.0e6)).collect()
    }

    fn area(corners: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
        let point = |corner: u32| corners[corner as usize];
        let twice = |[a, b, c]: [u32; 3]| (point(b) - point(a)).cross(point(c) - point(a));
        let normal: DVec3 = triangles.iter().map(|triangle| twice(*triangle)).sum();
        let sum: f64 = triangles.iter().map(|triangle| twice(*triangle).length()).sum();
        assert!((sum - normal.length()).abs() <= 1.0e-6 * sum, "all on one side, none over another");
        sum / 2.0
    }

    fn fan(count: usize) -> Vec<[u32; 3]> {
        (1..count as u32 - 1).map(|corner| [0, corner, corner + 1]).collect()
    }

    fn net(corners: &[DVec3]) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for pair in corners[1..].windows(2) {
            sum += (pair[0] - corners[0]).cross(pair[1] - corners[0]);
        }
        sum / 2.0
    }

    #[test]
    fn what_a_fan_fills_is_a_fan() {
        let polygons: [&[[f64; 2]]; 7] = [
            &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            &[[0.0, 0.0], [0.5, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.5]],
            &[[0.5, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]],
            &[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
            // Concave polygon whose first corner sees all others.
            &[[0.4, 1.0], [0.0, 0.0], [1.0, 1.0], [0.0, 2.0]],
            // Polygon on a line.
            &[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [2.0, 0.0]],
        ];
        let mut fills = Polygons::default();
        for polygon in polygons {
            for turned in [polygon.to_vec(), polygon.iter().rev().copied().collect()] {
                let is_fan = polygon[0] != [0.4, 1.0] || turned[0] == polygon[0];
                let found = fills.fill(&lifted(&turned));
                assert_eq!(found == Filling::Fan, is_fan, "{turned:?}: {found:?}");
            }
        }
        let round: Vec<[f64; 2]> = (0..1000)
            .map(|step| f64::from(step) * std::f64::consts::TAU / 1000.0)
            .map(|angle| [(1.0e6 * angle.cos()).round() / 1.0e6, (1.0e6 * angle.sin()).round() / 1.0e6])
            .collect();
        assert_eq!(fills.fill(&lifted(&round)), Filling::Fan);
        assert_eq!(fills.fill(&[]), Filling::Fan);
        let mut bad = lifted(polygons[1]);
        bad[2].x = f64::NAN;
        assert_eq!(fills.fill(&bad), Filling::Fan);
    }

    /// Corners on a line with their neighbours stay corners, and spikes show nothing.
    #[test]
    fn concave_polygons_are_filled_and_lose_no_corner() {
        let polygons: [(&[[f64; 2]], f64); 6] = [
            (&[[0.0, 0.0], [1.0, 1.0], [0.0, 2.0], [0.4, 1.0]], 0.6),
            // L shape with corners on its sides, one of them twice.
            (
                &[
                    [0.0, 0.0],
                    [1.0, 0.0],
                    [2.0, 0.0],
                    [2.0, 1.0],
                    [1.5, 1.0],
                    [1.5, 1.0],
                    [1.0, 1.0],
                    [1.0, 2.0],
                    [0.0, 2.0],
                    [0.0, 1.0],
                ],
                3.0,
            ),
            // Polygon that begins at another corner.
            (
                &[
                    [1.0, 2.0],
                    [0.0, 2.0],
                    [0.0, 1.0],
                    [0.0, 0.0],
                    [1.0, 0.0],
                    [2.0, 0.0],
                    [2.0, 1.0],
                    [1.5, 1.0],
                    [1.0, 1.0],
                ],
                3.0,
            ),
            // Polygon with a spike to the right.
            (&[[0.0, 0.0], [2.0, 0.0], [3.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.25], [0.0, 1.0]], 1.25),
            // Frame: a hole with a bridge to it.
            (
                &[
                    [0.0, 0.0],
                    [3.0, 0.0],
                    [3.0, 3.0],
                    [0.0, 3.0],
                    [0.0, 0.0],
                    [1.0, 1.0],
                    [1.0, 2.0],
                    [2.0, 2.0],
                    [2.0, 1.0],
                    [1.0, 1.0],
                ],
                8.0,
            ),
            // Thin arrow head.
            (&[[0.0, 0.0], [1000.0, 0.001], [0.0, 0.002], [500.0, 0.001]], 0.5),
        ];
        let slant = (1.0_f64 + 0.25 + 0.0625).sqrt();
        let mut fills = Polygons::default();
        for (polygon, wanted) in polygons {
            for shift in 0..polygon.len() {
                for backwards in [false, true] {
                    let mut turned = polygon.to_vec();
                    turned.rotate_left(shift);
                    if backwards {
                        turned.reverse();
                    }
                    let corners: Vec<DVec3> =
                        turned.iter().map(|[x, y]| DVec3::new(*x, *y, 0.5 * x - 0.25 * y)).collect();
                    let triangles = match fills.fill(&corners) {
                        Filling::Fan => fan(corners.len()),
                        Filling::Cut(triangles) => triangles,
                        Filling::Crossing => panic!("{turned:?} does not cross itself"),
                    };
                    assert_eq!(triangles.len(), corners.len() - 2);
                    let found = area(&corners, &triangles);
                    assert!((found - wanted * slant).abs() < 1.0e-6, "{turned:?}: {found}");
                    let facing: DVec3 = triangles
                        .iter()
                        .map(|triangle| triangle.map(|corner| corners[corner as usize]))
                        .map(|[a, b, c]| (b - a).cross(c - a))
                        .sum();
                    assert!(facing.dot(net(&corners)) > 0.0, "turned over");
                    for corner in 0..corners.len() as u32 {
                        assert!(triangles.iter().flatten().any(|used| *used == corner), "{corner} is lost");
                    }
                }
            }
        }
    }

    #[test]
    fn crossing_sides_are_told() {
        let polygons: [&[[f64; 2]]; 3] = [
            &[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]],
            &[[0.0, 0.0], [2.0, 1.0], [2.0, 0.0], [0.0, 3.0]],
            // Star of five points in one stroke.
            &[[0.0, 1.0], [0.588, -0.809], [-0.951, 0.309], [0.951, 0.309], [-0.588, -0.809]],
        ];
        for polygon in polygons {
            assert_eq!(Polygons::default().fill(&lifted(polygon)), Filling::Crossing, "{polygon:?}");
        }
    }

    /// The slowest cases are a comb whose teeth are all behind one another, and a spiral.
    #[test]
    fn large_polygons_take_no_time() {
        let start = std::time::Instant::now();
        let comb = (0..20_000).map(|step| [f64::from(step / 2), if step % 2 == 0 { 0.0 } else { 1.0e4 }]);
        let comb: Vec<[f64; 2]> = comb.chain([[10_000.0, -1.0], [-1.0, -1.0]]).collect();
        let turn = |step: f64, wide: f64| {
            let radius = 10.0 + step * 0.01 + wide;
            [radius * (step * 0.05).cos(), radius * (step * 0.05).sin()]
        };
        let out = (0..10_000).map(|step| turn(f64::from(step), 0.0));
        let spiral: Vec<[f64; 2]> =
            out.chain((0..10_000).rev().map(|step| turn(f64::from(step), 0.5))).collect();
        for polygon in [comb, spiral] {
            let corners = lifted(&polygon);
            match Polygons::default().fill(&corners) {
                Filling::Cut(triangles) => assert_eq!(triangles.len(), corners.len() - 2),
                other => panic!("{other:?}"),
            }
        }
        let seconds = start.elapsed().as_secs_f64();
        eprintln!("two polygons of 20,000 corners: {seconds:.2} s");
        assert!(seconds < 20.0, "{seconds} s");
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

        /// Corners at any distance around a point, in the order of their angles, make a polygon that does not
        /// cross itself.
        #[test]
        fn stars_are_filled(
            reach in prop::collection::vec(0.2_f64..5.0, 4..40),
            shift in 0_usize..40,
            backwards in any::<bool>(),
        ) {
            let count = reach.len();
            let mut flat: Vec<[f64; 2]> = reach.iter().enumerate().map(|(step, reach)| {
                let angle = std::f64::consts::TAU * step as f64 / count as f64;
                [reach * angle.cos(), reach * angle.sin()]
            }).collect();
            flat.rotate_left(shift % count);
            if backwards {
                flat.reverse();
            }
            let corners = lifted(&flat);
            let triangles = match Polygons::default().fill(&corners) {
                Filling::Fan => fan(count),
                Filling::Cut(triangles) => triangles,
                Filling::Crossing => panic!("{flat:?} does not cross itself"),
            };
            prop_assert_eq!(triangles.len(), count - 2);
            prop_assert!((area(&corners, &triangles) / net(&corners).length() - 1.0).abs() < 1.0e-6);
        }

        /// Any corners give an answer, with as many triangles as promised.
        #[test]
        fn any_polygon_is_answered(corners in prop::collection::vec(prop::array::uniform3(-3_i32..3), 0..24)) {
            let corners: Vec<DVec3> = corners.iter().map(|corner| DVec3::from(corner.map(f64::from))).collect();
            if let Filling::Cut(triangles) = Polygons::default().fill(&corners) {
                prop_assert_eq!(triangles.len() + 2, corners.len());
                prop_assert!(triangles.iter().flatten().all(|corner| (*corner as usize) < corners.len()));
            }
        }
    }
}

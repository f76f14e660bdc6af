//! The teapot of Martin Newell (University of Utah, 1975): 32 bicubic patches.

use glam::{DAffine3, DVec2, DVec3};

use super::shape::Shapes;

/// Control points of one curve of a patch of revolution: radius, radius times the bow of a quarter circle,
/// height.
type Profile = [[f64; 3]; 4];

/// Profiles of rim, body in two parts, bottom, knob and lid, each from its beginning down to its end.
const PROFILES: [Profile; 6] = [
    [[1.4, 0.784, 2.4], [1.3375, 0.749, 2.53125], [1.4375, 0.805, 2.53125], [1.5, 0.84, 2.4]],
    [[1.5, 0.84, 2.4], [1.75, 0.98, 1.875], [2.0, 1.12, 1.35], [2.0, 1.12, 0.9]],
    [[2.0, 1.12, 0.9], [2.0, 1.12, 0.45], [1.5, 0.84, 0.225], [1.5, 0.84, 0.15]],
    [[1.5, 0.84, 0.15], [1.5, 0.84, 0.075], [1.425, 0.798, 0.0], [0.0, 0.0, 0.0]],
    [[0.0, 0.0, 3.15], [0.8, 0.45, 3.15], [0.0, 0.0, 2.85], [0.2, 0.112, 2.7]],
    [[0.2, 0.112, 2.7], [0.4, 0.224, 2.55], [1.3, 0.728, 2.55], [1.3, 0.728, 2.4]],
];

/// Control points (x, z) of the two sides in the plane of symmetry, and the swelling of the half tube between
/// the sides: two patches of the handle, two of the spout, each in four rows.
type Half = [[f64; 5]; 4];

const HALVES: [Half; 4] = [
    [
        [-1.6, 2.025, -1.5, 2.25, 0.3],
        [-2.3, 2.025, -2.5, 2.25, 0.3],
        [-2.7, 2.025, -3.0, 2.25, 0.3],
        [-2.7, 1.8, -3.0, 1.8, 0.3],
    ],
    [
        [-2.7, 1.8, -3.0, 1.8, 0.3],
        [-2.7, 1.575, -3.0, 1.35, 0.3],
        [-2.5, 1.125, -2.65, 0.9375, 0.3],
        [-2.0, 0.9, -1.9, 0.6, 0.3],
    ],
    [
        [1.7, 1.425, 1.7, 0.6, 0.66],
        [2.6, 1.425, 3.1, 0.825, 0.66],
        [2.3, 2.1, 2.4, 2.025, 0.25],
        [2.7, 2.4, 3.3, 2.4, 0.25],
    ],
    [
        [2.7, 2.4, 3.3, 2.4, 0.25],
        [2.8, 2.475, 3.525, 2.49375, 0.25],
        [2.9, 2.475, 3.45, 2.5125, 0.15],
        [2.8, 2.4, 3.2, 2.4, 0.15],
    ],
];

/// Width of the body in the units of the control points. The pot is 3.15 high, and 6.5 from handle to spout.
pub(super) const BODY: f64 = 4.0;

/// Adds a teapot that stands on the origin of `place` with its spout towards +x, each patch as `steps` by
/// `steps` quads. As it was designed, the body is open below the edge of the lid, and handle and spout reach
/// into it.
pub(super) fn teapot(shapes: &mut Shapes, place: DAffine3, steps: usize) {
    for profile in PROFILES {
        for quarter in 0..4 {
            let rows = profile.map(|[radius, bow, z]| {
                [(radius, 0.0), (radius, -bow), (bow, -radius), (0.0, -radius)].map(|(x, y)| {
                    let (x, y) = match quarter {
                        0 => (x, y),
                        1 => (y, -x),
                        2 => (-x, -y),
                        _ => (-y, x),
                    };
                    DVec3::new(x, y, z)
                })
            });
            patch(shapes, &place, &rows, steps, false);
        }
    }
    for half in HALVES {
        for side in [-1.0, 1.0] {
            let rows = half.map(|[x0, z0, x1, z1, swell]| {
                let y = side * swell;
                [(x0, 0.0, z0), (x0, y, z0), (x1, y, z1), (x1, 0.0, z1)].map(DVec3::from)
            });
            patch(shapes, &place, &rows, steps, side > 0.0);
        }
    }
}

/// Adds one patch; "up" is the z axis of its control points. The front is on the other side if the patch is
/// `mirrored`.
fn patch(shapes: &mut Shapes, place: &DAffine3, rows: &[[DVec3; 4]; 4], steps: usize, mirrored: bool) {
    let upright = |point: DVec3| DVec3::new(point.x, point.z, -point.y);
    let normal_from_form = place.matrix3.inverse().transpose();
    let share = |step: usize| step as f64 / steps as f64;
    let mut grid = Vec::with_capacity((steps + 1) * (steps + 1));
    for (row, column) in (0..=steps).flat_map(|row| (0..=steps).map(move |column| (row, column))) {
        let (u, v) = (share(column), share(row));
        let (point, _, _) = bicubic(rows, u, v);
        // Beside an edge that is a single point there is still a normal.
        let inside = |share: f64| share.clamp(1.0e-4, 1.0 - 1.0e-4);
        let (_, along_u, along_v) = bicubic(rows, inside(u), inside(v));
        let normal = along_u.cross(along_v) * if mirrored { -1.0 } else { 1.0 };
        let normal = (normal_from_form * upright(normal)).normalize_or(DVec3::Y);
        let point = place.transform_point3(upright(point));
        grid.push((shapes.vertex(point, normal, DVec2::new(u, v)), point.as_vec3()));
    }
    for (row, column) in (0..steps).flat_map(|row| (0..steps).map(move |column| (row, column))) {
        let corner = |right: usize, down: usize| grid[(row + down) * (steps + 1) + column + right];
        let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        for [p, q, r] in [[a, b, c], [a, c, d]] {
            // At a single point one of the two triangles has no area.
            if p.1 != q.1 && q.1 != r.1 && r.1 != p.1 {
                shapes.triangle(if mirrored { [p.0, r.0, q.0] } else { [p.0, q.0, r.0] });
            }
        }
    }
}

/// Returns the point of a patch and its derivatives; u runs along a row, v over the rows.
fn bicubic(rows: &[[DVec3; 4]; 4], u: f64, v: f64) -> (DVec3, DVec3, DVec3) {
    let [mut points, mut slopes] = [[DVec3::ZERO; 4]; 2];
    for (row, controls) in rows.iter().enumerate() {
        (points[row], slopes[row]) = cubic(controls, u);
    }
    let ((point, along_v), (along_u, _)) = (cubic(&points, v), cubic(&slopes, v));
    (point, along_u, along_v)
}

/// Returns the point of a Bezier curve and its derivative.
fn cubic(controls: &[DVec3; 4], t: f64) -> (DVec3, DVec3) {
    let [a, b, c, d] = *controls;
    let s = 1.0 - t;
    let point = a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t);
    let slope = ((b - a) * (s * s) + (c - b) * (2.0 * s * t) + (d - c) * (t * t)) * 3.0;
    (point, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_as_large_as_the_original_and_its_fronts_are_outside() {
        let mut shapes = Shapes::new("teapot", 0);
        teapot(&mut shapes, DAffine3::IDENTITY, 12);
        let mesh = shapes.finish();
        let points: Vec<DVec3> =
            mesh.positions.iter().map(|point| DVec3::from_array(point.map(f64::from))).collect();
        let (low, high) = points
            .iter()
            .fold((points[0], points[0]), |(low, high), &point| (low.min(point), high.max(point)));
        assert!(low.distance(DVec3::new(-3.0, 0.0, -2.0)) < 0.02, "{low}");
        assert!(high.distance(DVec3::new(3.43, 3.15, 2.0)) < 0.02, "{high}");
        // Six times the volume to the axis; handle and spout are counted as well.
        let enclosed: f64 = mesh
            .indices
            .chunks_exact(3)
            .map(|corners| [0, 1, 2].map(|corner| points[corners[corner] as usize]))
            .map(|[a, b, c]| a.dot(b.cross(c)))
            .sum();
        assert!((6.0 * 20.0..6.0 * 30.0).contains(&enclosed), "{}", enclosed / 6.0);
    }
}

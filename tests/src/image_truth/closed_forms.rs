//! Form factors, occlusion and transmission in closed form, in f64.

use std::f64::consts::PI;

use glam::DVec3;

/// Returns the radiance everywhere in a closed diffuse enclosure that emits `emission` and reflects `albedo`,
/// after at most `bounces` scatterings.
pub fn enclosure(emission: f64, albedo: f64, bounces: u32) -> f64 {
    emission * (0..=bounces).rev().fold(0.0, |sum, _| 1.0 + albedo * sum)
}

/// Returns the form factor between two equal, parallel, opposite rectangles of `width` by `depth`, `distance`
/// apart (Howell C-11). Metres.
pub fn parallel_rectangles(width: f64, depth: f64, distance: f64) -> f64 {
    let (x, y) = (width / distance, depth / distance);
    let (xx, yy) = (1.0 + x * x, 1.0 + y * y);
    let logarithm = 0.5 * (xx * yy / (xx + yy - 1.0)).ln();
    let across = x * yy.sqrt() * (x / yy.sqrt()).atan() + y * xx.sqrt() * (y / xx.sqrt()).atan();
    2.0 / (PI * x * y) * (logarithm + across - x * x.atan() - y * y.atan())
}

/// Returns the form factor from a rectangle of `edge` by `depth` to one of `edge` by `height` that stands
/// upright on the common edge (Howell C-14). Metres.
pub fn perpendicular_rectangles(edge: f64, depth: f64, height: f64) -> f64 {
    let (w, h) = (depth / edge, height / edge);
    let (ww, hh) = (w * w, h * h);
    let diagonal = ww + hh;
    let angles =
        w * (1.0 / w).atan() + h * (1.0 / h).atan() - diagonal.sqrt() * (1.0 / diagonal.sqrt()).atan();
    let powers = ((1.0 + ww) * (1.0 + hh) / (1.0 + diagonal)).ln()
        + ww * (ww * (1.0 + diagonal) / ((1.0 + ww) * diagonal)).ln()
        + hh * (hh * (1.0 + diagonal) / ((1.0 + hh) * diagonal)).ln();
    (angles + 0.25 * powers) / (PI * w)
}

/// Returns the irradiance that a polygon of radiance 1 casts on a surface element at `point` with the unit
/// `normal`, W/m^2: Lambert's sum over the edges of the part above the horizon. Corners in order, metres.
pub fn polygon_irradiance(point: DVec3, normal: DVec3, corners: &[DVec3]) -> f64 {
    let above = above_horizon(point, normal, corners);
    let edge = |i: usize| {
        let (a, b) = (above[i], above[(i + 1) % above.len()]);
        // An edge in line with the point subtends no angle.
        a.angle_between(b) * normal.dot(a.cross(b).normalize_or_zero())
    };
    0.5 * (0..above.len()).map(edge).sum::<f64>().abs()
}

/// Returns the part of a polygon on the side of the plane through `point` that `normal` points to, relative
/// to `point`.
fn above_horizon(point: DVec3, normal: DVec3, corners: &[DVec3]) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(corners.len() + 2);
    for (i, corner) in corners.iter().enumerate() {
        let (a, b) = (*corner - point, corners[(i + 1) % corners.len()] - point);
        let (height_a, height_b) = (normal.dot(a), normal.dot(b));
        if height_a >= 0.0 {
            kept.push(a);
        }
        if (height_a < 0.0) != (height_b < 0.0) {
            kept.push(a + (b - a) * (height_a / (height_a - height_b)));
        }
    }
    kept
}

/// Returns the cosine-weighted share of the sky that a closed convex body hides from a surface element at
/// `point` with the unit `normal`: the irradiance of its triangles that face the point, none of which
/// overlap.
pub fn convex_occlusion(point: DVec3, normal: DVec3, triangles: &[[DVec3; 3]]) -> f64 {
    let faces = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a).dot(point - *a) > 0.0;
    let hidden = triangles.iter().filter(|triangle| faces(triangle));
    hidden.map(|triangle| polygon_irradiance(point, normal, triangle)).sum::<f64>() / PI
}

/// Returns the cosine-weighted share of the sky that a sphere of `radius` hides, whose centre is `height`
/// above the plane and `distance` aside; the sphere must lie above the plane. Metres.
pub fn next_to_sphere(radius: f64, height: f64, distance: f64) -> f64 {
    let squared = height * height + distance * distance;
    height * radius * radius / (squared * squared.sqrt())
}

/// Returns the reflectance at normal incidence between indices of refraction of 1 and `ior`.
pub fn normal_reflectance(ior: f64) -> f64 {
    ((ior - 1.0) / (ior + 1.0)).powi(2)
}

/// Returns the share of light that passes a stack of interfaces with these reflectances at normal incidence,
/// with all reflections between them, without interference and absorption.
pub fn interface_transmission(reflectances: &[f64]) -> f64 {
    1.0 / (1.0 + reflectances.iter().map(|r| r / (1.0 - r)).sum::<f64>())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }

    #[test]
    fn tabulated_values() {
        near(parallel_rectangles(1.0, 1.0, 1.0), 0.199_824_896);
        near(perpendicular_rectangles(1.0, 1.0, 1.0), 0.200_043_776);
        // The faces of a cube see only each other.
        near(parallel_rectangles(1.0, 1.0, 1.0) + 4.0 * perpendicular_rectangles(1.0, 1.0, 1.0), 1.0);
        near(1.0 - next_to_sphere(1.0, 1.0, 0.5), 0.284_458);
        near(enclosure(1.0, 0.5, 3), 1.875);
        near(enclosure(1.0, 0.8, 400), 5.0);
        for (sheets, through) in [(1, 0.923_077), (2, 0.857_143), (4, 0.75), (8, 0.6)] {
            near(interface_transmission(&vec![normal_reflectance(1.5); 2 * sheets]), through);
        }
    }

    #[test]
    fn closure_and_reciprocity() {
        // The box is 2 by 3 by 5: from the face 2 by 3, one face is opposite and two of each kind are
        // adjacent.
        let sum = parallel_rectangles(2.0, 3.0, 5.0)
            + 2.0 * perpendicular_rectangles(2.0, 3.0, 5.0)
            + 2.0 * perpendicular_rectangles(3.0, 2.0, 5.0);
        near(sum, 1.0);
        near(perpendicular_rectangles(2.0, 3.0, 5.0) * 3.0, perpendicular_rectangles(2.0, 5.0, 3.0) * 5.0);
    }

    #[test]
    fn polygons_around_the_point_and_across_the_horizon() {
        let up = DVec3::Y;
        // A very large square overhead covers the sky: irradiance pi.
        let square = |half: f64, y: f64| {
            [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, z)| DVec3::new(x, y, z))
        };
        assert!((polygon_irradiance(DVec3::ZERO, up, &square(1e5, 1.0)) / PI - 1.0).abs() < 1e-4);
        assert_eq!(polygon_irradiance(DVec3::ZERO, up, &square(1.0, -1.0)), 0.0);
        // A long wall of height 1 is seen from distance 1; the part below the horizon does not count.
        let wall = |bottom: f64| {
            [(bottom, -1e4), (bottom, 1e4), (1.0, 1e4), (1.0, -1e4)].map(|(y, z)| DVec3::new(1.0, y, z))
        };
        let expected = 0.5 * (1.0 - 0.5_f64.sqrt());
        assert!((polygon_irradiance(DVec3::ZERO, up, &wall(0.0)) / PI - expected).abs() < 1e-4);
        near(
            polygon_irradiance(DVec3::ZERO, up, &wall(-7.0)),
            polygon_irradiance(DVec3::ZERO, up, &wall(0.0)),
        );
    }

    #[test]
    fn a_body_of_many_facets_hides_what_its_sphere_hides() {
        let mesh = crate::image_truth::octahedron_sphere(DVec3::Y * 1.1, 1.0, 5, 0);
        let triangles = crate::image_truth::scenes::triangles(&mesh);
        for distance in [0.5, 1.0, 2.0] {
            let point = DVec3::X * distance;
            let hidden = convex_occlusion(point, DVec3::Y, &triangles);
            // Facets lie inside the sphere by less than a thousandth of its radius.
            let sphere = next_to_sphere(1.0, 1.1, distance);
            assert!(hidden < sphere && hidden > sphere * 0.997, "{distance}: {hidden} {sphere}");
        }
    }
}

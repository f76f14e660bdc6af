//! Origin of f32 coordinates.

use glam::DVec3;

/// Number of cells of the default grid of frame origins per diagonal of the scene.
const CELLS_PER_DIAGONAL: f64 = 8.0;

/// Largest distance of the eye from the world's origin, in cells of that grid, at which the frame origin
/// stays there: four to eight diagonals of the scene. At smaller distances, moving the origin would round
/// once more positions that files give exactly, and gain at most three of their 24 bits.
const CELLS_OF_WORLD: f64 = 64.0;

/// Distance, metres, beyond which the frame origin follows the eye in any scene: f32 resolves a millimetre
/// there.
const FARTHEST_FROM_WORLD: f64 = 16_384.0;

/// Smallest and largest binary exponent of the grid: finer than any scene needs, and far from the largest
/// coordinate that a mesh may have.
const EXPONENTS: std::ops::RangeInclusive<i32> = -40..=60;

/// Returns the grid spacing in metres for a scene with the given diagonal (metres): the largest power of two
/// that is not above an eighth of it. A diagonal that is zero or not finite gives 1 metre.
pub fn frame_origin_spacing(diagonal: f64) -> f64 {
    if !diagonal.is_finite() || diagonal <= 0.0 {
        return 1.0;
    }
    let exponent = (diagonal / CELLS_PER_DIAGONAL).log2().floor();
    let exponent = exponent.clamp(f64::from(*EXPONENTS.start()), f64::from(*EXPONENTS.end()));
    exponent.exp2()
}

/// Returns the default frame origin: the world's, unless a coordinate of the eye (world, metres) is more than
/// 64 times `spacing` or 16,384 m; then the eye snapped to the nearest point of a grid of `spacing` metres.
/// With a power-of-two spacing the result is exact, and it changes only when the eye leaves a cell, so a
/// moving camera rarely forces a rebuild. Coordinates of an eye that are not finite count as 0.
///
/// The farther a point lies from the frame origin, the coarser its f32 position: points within one
/// cell of the eye keep about 24 bits of a cell.
pub fn snap_frame_origin(eye: DVec3, spacing: f64) -> DVec3 {
    let farthest = FARTHEST_FROM_WORLD.min(CELLS_OF_WORLD * spacing);
    if !eye.to_array().iter().any(|x| x.is_finite() && x.abs() > farthest) {
        return DVec3::ZERO;
    }
    let snap = |x: f64| if x.is_finite() { (x / spacing).round() * spacing + 0.0 } else { 0.0 };
    DVec3::new(snap(eye.x), snap(eye.y), snap(eye.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spacing_is_a_power_of_two_below_an_eighth_of_the_diagonal() {
        for diagonal in [1e-6, 0.3, 1.0, 8.0, 20.0, 12345.0, 1e9] {
            let spacing = frame_origin_spacing(diagonal);
            assert_eq!(spacing.log2().fract(), 0.0, "{spacing}");
            assert!(spacing <= diagonal / 8.0 && spacing > diagonal / 16.0 - 1e-300, "{diagonal} {spacing}");
        }
        assert_eq!(frame_origin_spacing(0.0), 1.0);
        assert_eq!(frame_origin_spacing(f64::INFINITY), 1.0);
        assert_eq!(frame_origin_spacing(f64::NAN), 1.0);
    }

    #[test]
    fn the_origin_stays_while_the_eye_moves_within_a_cell() {
        let origin = snap_frame_origin(DVec3::new(148_376.2, 1_234.0, -223_423.4), 4.0);
        assert_eq!(origin, DVec3::new(148_376.0, 1_236.0, -223_424.0));
        let moved = snap_frame_origin(DVec3::new(148_377.9, 1_235.9, -223_422.1), 4.0);
        assert_eq!(origin, moved);
        assert_ne!(origin, snap_frame_origin(DVec3::new(148_378.1, 1_235.9, -223_422.1), 4.0));
    }

    #[test]
    fn an_eye_near_the_world_origin_keeps_it() {
        for eye in [DVec3::new(-0.4, 0.3, f64::NAN), DVec3::new(0.31, -64.0, 63.9), DVec3::INFINITY] {
            let origin = snap_frame_origin(eye, 1.0);
            assert_eq!(origin.to_array().map(f64::to_bits), [0, 0, 0], "{eye}");
        }
        assert_eq!(snap_frame_origin(DVec3::new(0.3, 64.6, 0.0), 1.0), DVec3::new(0.0, 65.0, 0.0));
    }
}

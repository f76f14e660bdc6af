//! Probability of each kind of light: by its power, as far as the scene alone determines it.

use std::f64::consts::PI;

use rasray_scene::Light;

use crate::distribution::luminance;

/// Least probability of a kind that exists, before the sum is normalised to 1: power says nothing about
/// distance.
const LEAST: f64 = 0.1;

/// Returns the luminous power of a light without extent, W; `disk` is the largest projected area of all
/// triangles, m^2.
pub fn punctual_power(light: &Light, disk: f64) -> f64 {
    match *light {
        Light::Point { intensity, .. } => 4.0 * PI * luminance(intensity),
        Light::Directional { irradiance, .. } => disk * luminance(irradiance),
        Light::Spot { intensity, inner_cone, outer_cone, .. } => {
            let cosine = 0.5 * (f64::from(inner_cone).cos() + f64::from(outer_cone).cos());
            2.0 * PI * (1.0 - cosine) * luminance(intensity)
        }
    }
}

/// Returns the area of the circle around a box, m^2, on which light from far away falls.
pub fn disk_of(lower: [f32; 3], upper: [f32; 3]) -> f64 {
    let squared: f64 = (0..3).map(|axis| (f64::from(upper[axis]) - f64::from(lower[axis])).powi(2)).sum();
    0.25 * PI * squared
}

/// Returns the probabilities of punctual lights, emissive triangles and environment from their powers; `None`
/// stands for a kind that does not exist.
pub fn kind_shares(powers: [Option<f64>; 3]) -> [f32; 3] {
    let present = powers.iter().flatten().count();
    if present == 0 {
        return [0.0; 3];
    }
    let total: f64 = powers.iter().flatten().sum();
    let share = |power: f64| if total > 0.0 { power / total } else { 1.0 / present as f64 };
    let weights = powers.map(|power| power.map_or(0.0, |power| share(power).max(LEAST)));
    let sum: f64 = weights.iter().sum();
    let mut shares = weights.map(|weight| (weight / sum) as f32);
    // The last kind gets the rest of the rounding, so that every number selects a kind.
    if let Some(last) = powers.iter().rposition(Option::is_some) {
        let others: f32 = (0..last).map(|kind| shares[kind]).sum();
        shares[last] = 1.0 - others;
    }
    shares
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn kinds_are_chosen_by_power_but_never_left_out() {
        assert_eq!(kind_shares([None; 3]), [0.0; 3]);
        assert_eq!(kind_shares([None, Some(0.0), None]), [0.0, 1.0, 0.0]);
        assert_eq!(kind_shares([Some(0.0), None, Some(0.0)]), [0.5, 0.0, 0.5]);
        let shares = kind_shares([Some(3.0), Some(1.0), None]);
        assert!((shares[0] - 0.75).abs() < 1e-6 && (shares[1] - 0.25).abs() < 1e-6, "{shares:?}");
        let shares = kind_shares([Some(1.0), Some(1.0), Some(1e9)]);
        assert!((shares[0] - 0.1 / 1.2).abs() < 1e-6 && shares[2] > 0.8, "{shares:?}");
        assert_eq!(shares.iter().sum::<f32>(), 1.0);
    }

    #[test]
    fn powers_are_those_of_the_whole_sphere_and_of_the_cone() {
        let position = glam::DVec3::ZERO;
        let point = Light::Point { position, intensity: [1.0; 3], range: 1.0 };
        assert_abs_diff_eq!(punctual_power(&point, 0.0), 4.0 * PI, epsilon = 1e-6);
        let spot = |outer_cone| Light::Spot {
            position,
            direction: glam::DVec3::X,
            intensity: [1.0; 3],
            range: 1.0,
            inner_cone: outer_cone,
            outer_cone,
        };
        assert_abs_diff_eq!(
            punctual_power(&spot(std::f32::consts::FRAC_PI_2), 0.0),
            2.0 * PI,
            epsilon = 1e-6
        );
        assert!(punctual_power(&spot(0.1), 0.0) < 0.04);
        let sun = Light::Directional { direction: glam::DVec3::X, irradiance: [2.0; 3] };
        assert_abs_diff_eq!(
            punctual_power(&sun, disk_of([0.0; 3], [2.0, 0.0, 0.0])),
            2.0 * PI,
            epsilon = 1e-6
        );
    }
}

//! Radiance of rays that leave the scene, and the choice of directions towards it.

use std::f64::consts::PI;

use rasray_scene::Environment;
use rasray_shaders_glsl::constants::scene::{ENVIRONMENT_CONSTANT, ENVIRONMENT_LAT_LONG};

use crate::{
    GpuSceneError,
    distribution::{cumulative_shares, luminance},
};

/// Packed environment.
#[derive(Clone, Debug, Default)]
pub struct EnvironmentTables {
    /// Kind of environment, one of `ENVIRONMENT_*`.
    pub kind: u32,
    /// Texels per row; 0 for a constant environment.
    pub width: u32,
    /// Rows; 0 for a constant environment.
    pub height: u32,
    /// True if any radiance is above zero.
    pub emits: bool,
    /// Luminance of the radiance over the whole sphere, W/m^2.
    pub irradiance: f64,
    /// Radiance of a constant environment, W/(sr m^2).
    pub constant: [f32; 3],
    /// Radiance of the texels, three words each.
    pub radiance: Vec<f32>,
    /// Cumulative share of the rows, then of the texels within every row.
    pub distribution: Vec<f32>,
}

/// Packs the environment. Radiance that is negative or not finite counts as 0, with a warning in the log that
/// counts the texels.
///
/// # Errors
/// `Malformed` where a map has another number of texels than its size says.
pub fn pack_environment(environment: &Environment) -> Result<EnvironmentTables, GpuSceneError> {
    match environment {
        Environment::Constant(radiance) => {
            let (constant, _) = clean(*radiance);
            Ok(EnvironmentTables {
                kind: ENVIRONMENT_CONSTANT,
                emits: luminance(constant) > 0.0,
                irradiance: 4.0 * PI * luminance(constant),
                constant,
                ..EnvironmentTables::default()
            })
        }
        Environment::LatLong { width, height, radiance } => {
            let texels = *width as usize * *height as usize;
            if texels == 0 || radiance.len() != texels {
                return Err(GpuSceneError::Malformed {
                    what: format!("the environment of {width} x {height} texels needs one radiance each"),
                    limit: radiance.len(),
                });
            }
            Ok(pack_map(*width, *height, radiance))
        }
    }
}

/// Returns the words of an environment's tables: radiance, then distribution.
pub fn environment_words(environment: &Environment) -> [u64; 2] {
    match environment {
        Environment::Constant(_) => [0; 2],
        Environment::LatLong { height, radiance, .. } => {
            let texels = radiance.len() as u64;
            [3 * texels, u64::from(*height) + texels]
        }
    }
}

fn pack_map(width: u32, height: u32, radiance: &[[f32; 3]]) -> EnvironmentTables {
    let mut cleaned = Vec::with_capacity(radiance.len());
    let mut replaced = 0u64;
    for &texel in radiance {
        let (texel, changed) = clean(texel);
        replaced += u64::from(changed);
        cleaned.push(texel);
    }
    if replaced > 0 {
        tracing::warn!("{replaced} texels of the environment are negative or not finite and count as black");
    }
    let mut row_weights = Vec::with_capacity(height as usize);
    let mut within_rows = Vec::with_capacity(radiance.len());
    for (y, row) in cleaned.chunks_exact(width as usize).enumerate() {
        let solid_angle = texel_solid_angle(width, height, y as u32);
        let weights: Vec<f64> = row.iter().map(|&texel| luminance(texel) * solid_angle).collect();
        let (total, shares) = cumulative_shares(&weights);
        row_weights.push(total);
        within_rows.extend(shares);
    }
    let (total, mut distribution) = cumulative_shares(&row_weights);
    distribution.extend(within_rows);
    EnvironmentTables {
        kind: ENVIRONMENT_LAT_LONG,
        width,
        height,
        emits: total > 0.0,
        irradiance: total,
        constant: [0.0; 3],
        radiance: cleaned.into_iter().flatten().collect(),
        distribution,
    }
}

/// Returns the solid angle, in steradians, of a texel of row `y` (from the top) of a latitude-longitude map.
pub fn texel_solid_angle(width: u32, height: u32, y: u32) -> f64 {
    let (width, height) = (f64::from(width), f64::from(height));
    (2.0 * PI / width) * 2.0 * (PI * (f64::from(y) + 0.5) / height).sin() * (PI / (2.0 * height)).sin()
}

fn clean(radiance: [f32; 3]) -> ([f32; 3], bool) {
    let cleaned = radiance.map(|x| if x.is_finite() { x.max(0.0) } else { 0.0 });
    (cleaned, cleaned != radiance)
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn solid_angles_sum_to_the_sphere() {
        for (width, height) in [(1, 1), (7, 5), (64, 32)] {
            let sum: f64 = (0..height).map(|y| f64::from(width) * texel_solid_angle(width, height, y)).sum();
            assert_abs_diff_eq!(sum, 4.0 * PI, epsilon = 1e-12);
        }
    }

    #[test]
    fn a_white_map_is_chosen_by_solid_angle() {
        let map = Environment::LatLong { width: 4, height: 2, radiance: vec![[1.0; 3]; 8] };
        let packed = pack_environment(&map).expect("a valid map");
        assert_eq!(packed.distribution.len(), 2 + 8);
        assert_eq!(packed.distribution, [0.5, 1.0, 0.25, 0.5, 0.75, 1.0, 0.25, 0.5, 0.75, 1.0]);
        assert!(packed.emits);
    }

    #[test]
    fn one_bright_texel_is_always_chosen() {
        let mut radiance = vec![[0.0; 3]; 6];
        radiance[4] = [0.0, 5.0, 0.0];
        radiance[0] = [f32::NAN, -1.0, 0.0];
        let map = Environment::LatLong { width: 3, height: 2, radiance };
        let packed = pack_environment(&map).expect("a valid map");
        assert_eq!(packed.distribution, [0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0]);
        assert!(packed.radiance.iter().all(|x| x.is_finite()));
    }

    #[test]
    fn black_and_malformed_environments_are_told_apart() {
        let black = pack_environment(&Environment::Constant([0.0; 3])).expect("valid");
        assert!(!black.emits && black.kind == ENVIRONMENT_CONSTANT);
        let short = Environment::LatLong { width: 4, height: 2, radiance: vec![[1.0; 3]; 7] };
        assert!(matches!(pack_environment(&short), Err(GpuSceneError::Malformed { .. })));
    }
}

//! Options of shadow maps.

use rasray_ads::AdsError;

/// Options of shadow maps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Number of texels along a side of a view, from [`Config::LEAST_TEXELS`] to [`Config::MOST_TEXELS`].
    pub resolution: u32,
    /// Bias of depths, from 0 to 16, in multiples of the depth that the triangle's plane gains within half a
    /// texel. Each texel lies this much deeper than the triangle at its centre. With 1, no flat surface
    /// shades itself.
    pub bias: f32,
    /// Number of points on each emitting triangle, each with a cube of maps, from 0 to
    /// [`Config::MOST_POINTS`]. With 0, a structure traces the shadow rays that lead to emitting triangles.
    pub points: u32,
}

impl Config {
    /// Minimum number of texels along a side.
    pub const LEAST_TEXELS: u32 = 16;

    /// Maximum number of texels along a side.
    pub const MOST_TEXELS: u32 = 16_384;

    /// Default number of texels along a side.
    pub const DEFAULT_TEXELS: u32 = 1024;

    /// Maximum number of points on each emitting triangle.
    pub const MOST_POINTS: u32 = 1024;

    /// Returns options with `resolution` texels along a side, a bias of 1, and no points on emitting
    /// triangles.
    pub fn new(resolution: u32) -> Self {
        Self { resolution, bias: 1.0, points: 0 }
    }

    /// Checks the ranges of all options.
    ///
    /// # Errors
    /// An option is out of range.
    pub fn validate(&self) -> Result<(), AdsError> {
        let wrong = |option, value: String, expected| Err(AdsError::Option { option, value, expected });
        if !(Self::LEAST_TEXELS..=Self::MOST_TEXELS).contains(&self.resolution) {
            return wrong(
                "shadow-resolution",
                self.resolution.to_string(),
                "from 16 to 16384 texels along a side",
            );
        }
        if !(0.0..=16.0).contains(&self.bias) {
            return wrong("bias", self.bias.to_string(), "from 0 to 16 times the slope within half a texel");
        }
        if self.points > Self::MOST_POINTS {
            return wrong(
                "shadow-points",
                self.points.to_string(),
                "from 0 to 1024 on each emitting triangle",
            );
        }
        Ok(())
    }
}

impl Default for Config {
    fn default() -> Self {
        Self::new(Self::DEFAULT_TEXELS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_out_of_range_is_refused_by_name() {
        assert!(
            Config::default().validate().is_ok()
                && Config { bias: 0.0, ..Config::new(16) }.validate().is_ok()
        );
        for (config, name) in [
            (Config::new(15), "shadow-resolution"),
            (Config::new(16_385), "shadow-resolution"),
            (Config { bias: -0.5, ..Config::new(64) }, "bias"),
            (Config { bias: f32::NAN, ..Config::new(64) }, "bias"),
            (Config { points: 1025, ..Config::new(64) }, "shadow-points"),
        ] {
            assert!(config.validate().expect_err("refused").to_string().starts_with(name), "{config:?}");
        }
    }
}

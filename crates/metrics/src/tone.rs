//! Conversion of linear light to the values of a screen.

mod aces;
mod agx;

use crate::image::Image;

/// Exposure of linear colours, and the curve that then brings them into the range of a screen. The default is
/// exposure 0 and no curve beyond that of sRGB.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tone {
    /// Curve that brings exposed colours into the range of a screen.
    pub curve: ToneCurve,
    /// Exposure in stops: colours are multiplied by 2 to this power first.
    pub exposure: f32,
}

impl From<f32> for Tone {
    /// Makes a tone of exposure alone, in stops.
    fn from(exposure: f32) -> Self {
        Self { exposure, ..Self::default() }
    }
}

/// Curve that brings exposed colours into the range of a screen. All end with the sRGB transfer curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneCurve {
    /// No curve: values are clamped to 0 to 1.
    #[default]
    Exposure,
    /// AgX by Troy Sobotka, in the version of Eary Chow for Blender 4.
    Agx,
    /// ACES 1 for a standard screen (RRT and ODT), as fitted by Stephen Hill.
    Aces,
}

impl ToneCurve {
    /// All curves.
    pub const ALL: [Self; 3] = [Self::Exposure, Self::Agx, Self::Aces];

    /// Name on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exposure => "exposure",
            Self::Agx => "agx",
            Self::Aces => "aces",
        }
    }

    /// Description, one line of help.
    pub fn doc(self) -> &'static str {
        match self {
            Self::Exposure => "None: clamped to 0 to 1, so that other programs reproduce every value",
            Self::Agx => "AgX, as Blender shows pictures: bright colours fade to white",
            Self::Aces => "ACES 1 for a standard screen, by the fit of Hill: more contrast and colour",
        }
    }
}

impl Tone {
    /// Returns the linear light of a screen, 0 to 1, for a linear colour of Rec. 709. NaN becomes 0.
    pub fn shown(self, linear: [f32; 3]) -> [f32; 3] {
        let scale = self.exposure.exp2();
        let exposed = linear.map(|value| value * scale);
        match self.curve {
            ToneCurve::Exposure => exposed.map(clamped),
            ToneCurve::Agx => agx::agx(exposed.map(finite)).map(clamped),
            ToneCurve::Aces => aces::aces(exposed.map(finite)).map(clamped),
        }
    }
}

/// Converts linear light to values as shown: exposure 1, clamped to [0, 1], sRGB transfer curve. NaN becomes
/// zero. Metrics of perception (PSNR, SSIM, FLIP) are defined on these values.
pub fn display_values(image: &Image<'_>) -> Vec<[f32; 3]> {
    image.pixels().iter().map(|pixel| pixel.map(|value| encode(clamped(value)))).collect()
}

/// Returns three bytes of sRGB per pixel, rounded to the nearest step. `tone` is a number, which is exposure
/// in stops, or a [`Tone`].
pub fn tone_map(linear: &[[f32; 3]], tone: impl Into<Tone>) -> Vec<u8> {
    let tone = tone.into();
    linear
        .iter()
        .flat_map(|pixel| tone.shown(*pixel))
        .map(|value| (encode(value) * 255.0 + 0.5) as u8)
        .collect()
}

/// Clamps a value to 0 to 1; NaN becomes 0.
fn clamped(linear: f32) -> f32 {
    if linear.is_nan() { 0.0 } else { linear.clamp(0.0, 1.0) }
}

/// Limits light to values for which curves can be computed in single precision. NaN becomes 0.
fn finite(linear: f32) -> f32 {
    if linear.is_nan() { 0.0 } else { linear.clamp(0.0, 1.0e15) }
}

/// Applies the sRGB transfer curve to a value from 0 to 1.
fn encode(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Multiplies the rows of a matrix by a column.
fn transform(rows: &[[f32; 3]; 3], column: [f32; 3]) -> [f32; 3] {
    rows.map(|[x, y, z]| x * column[0] + y * column[1] + z * column[2])
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    /// Returns the greatest difference from published values, in steps of 255. Rows are linear colours and
    /// the values shown.
    pub(super) fn farthest(curve: ToneCurve, published: &[([f32; 3], [f32; 3])]) -> f32 {
        let tone = Tone { curve, exposure: 0.0 };
        let far = |(linear, shown): &([f32; 3], [f32; 3])| {
            let ours = tone.shown(*linear).map(|value| 255.0 * encode(value));
            (0..3).map(|channel| (ours[channel] - shown[channel]).abs()).fold(0.0, f32::max)
        };
        published.iter().map(far).fold(0.0, f32::max)
    }

    #[test]
    fn ends_knee_and_middle() {
        let encoded = |value| encode(clamped(value));
        assert_eq!([-1.0, 0.0, f32::NAN].map(encoded), [0.0; 3]);
        assert!([1.0, 7.0, f32::INFINITY].iter().all(|x| (encoded(*x) - 1.0).abs() < 1e-6));
        assert_abs_diff_eq!(encode(0.003_130_8), 0.040_45, epsilon = 1e-5);
        assert_abs_diff_eq!(encode(0.214_041), 0.5, epsilon = 1e-5);
    }

    #[test]
    fn the_curve_is_srgb() {
        let values = [[f32::NAN, -1.0, 0.0], [0.002, 0.214_041_14, 0.5], [1.0, 2.0, f32::INFINITY]];
        assert_eq!(tone_map(&values, 0.0), [0, 0, 0, 7, 128, 188, 255, 255, 255]);
    }

    #[test]
    fn a_stop_doubles() {
        for curve in ToneCurve::ALL {
            let mapped =
                |value, exposure| tone_map(&[[value, 0.4 * value, 1.2 * value]], Tone { curve, exposure });
            assert_eq!(mapped(0.25, 1.0), mapped(0.5, 0.0), "{curve:?}");
            assert_eq!(mapped(0.5, -1.0), mapped(0.25, 0.0), "{curve:?}");
        }
    }

    #[test]
    fn every_curve_keeps_grey_grey_and_its_order_and_takes_any_number() {
        for curve in ToneCurve::ALL {
            let tone = Tone { curve, exposure: 0.0 };
            let mut before = -1.0;
            for step in -160..160 {
                let [red, green, blue] = tone.shown([(step as f32 / 10.0).exp2(); 3]);
                assert!((red - green).abs() < 2.0e-3 && (red - blue).abs() < 2.0e-3, "{curve:?} {step}");
                assert!(green >= before, "{curve:?} {step}: {green} after {before}");
                before = green;
            }
            assert!(before > 0.999, "{curve:?} {before}");
            for strange in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, -1.0, 1.0e-40] {
                for colour in [[strange; 3], [strange, 0.5, 0.0], [0.0, 1.0, strange]] {
                    let shown = tone.shown(colour);
                    assert!(
                        shown.iter().all(|value| (0.0..=1.0).contains(value)),
                        "{curve:?} {colour:?} {shown:?}"
                    );
                }
            }
            assert_eq!(tone_map(&[[0.0; 3]], tone), [0; 3], "{curve:?}");
        }
    }
}

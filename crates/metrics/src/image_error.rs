use crate::error::MetricsError;
use crate::image::{Image, check};
use crate::statistics::percentile;
use crate::tone::display_values;

/// Term that keeps the relative error finite for black references.
const RELATIVE_EPSILON: f64 = 1e-2;

/// Differences of an image R from a reference r. Sums run over pixels and channels.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ImageError {
    /// Number of pixels with a NaN or infinite channel. The figures in linear light leave them out; those of
    /// displayed values take NaN for black and infinity for white.
    pub non_finite: usize,
    /// Mean absolute error: mean |R - r|, linear.
    pub mae: f64,
    /// Mean squared error: mean (R - r)^2, linear.
    pub mse: f64,
    /// Root of `mse`.
    pub rmse: f64,
    /// Relative mean squared error: mean (R - r)^2 / (r^2 + 0.01), linear.
    pub relmse: f64,
    /// `relmse` without the greatest 0.1 % of its terms, so that a few fireflies do not decide.
    pub relmse_trimmed: f64,
    /// Bias: mean (R - r), linear, which no number of samples removes.
    pub bias: f64,
    /// Standard error of `bias` for independent errors of pixels.
    pub bias_sigma: f64,
    /// Peak signal-to-noise ratio: 10 log10(1 / MSE) of displayed values, in decibels; infinite for equal
    /// images.
    pub psnr: f64,
    /// Mean structural similarity of displayed luma, see [`crate::ssim`]; 1 for equal images.
    pub ssim: f64,
    /// FLIP of displayed values.
    #[cfg(feature = "flip")]
    pub flip: crate::flip::Flip,
}

impl ImageError {
    /// Compares two images of one size.
    ///
    /// # Errors
    /// An error if the sizes differ, a pixel of the reference is not finite, or the image is too large for
    /// FLIP.
    pub fn measure(test: &Image<'_>, reference: &Image<'_>) -> Result<Self, MetricsError> {
        check(test, reference)?;
        let mut differences = Vec::with_capacity(test.pixels().len() * 3);
        let mut relative = Vec::with_capacity(test.pixels().len() * 3);
        let mut non_finite = 0;
        for (pixel, truth) in test.pixels().iter().zip(reference.pixels()) {
            if !pixel.iter().all(|x| x.is_finite()) {
                non_finite += 1;
                continue;
            }
            for (value, truth) in pixel.iter().zip(truth) {
                let (value, truth) = (f64::from(*value), f64::from(*truth));
                differences.push(value - truth);
                relative.push((value - truth).powi(2) / (truth * truth + RELATIVE_EPSILON));
            }
        }
        let mse = mean(differences.iter().map(|d| d * d));
        let bias = mean(differences.iter().copied());
        let variance = (mse - bias * bias).max(0.0);
        let limit = percentile(&relative, 0.999).unwrap_or(f64::INFINITY);
        Ok(Self {
            non_finite,
            mae: mean(differences.iter().map(|d| d.abs())),
            mse,
            rmse: mse.sqrt(),
            relmse: mean(relative.iter().copied()),
            relmse_trimmed: mean(relative.iter().copied().filter(|r| *r <= limit)),
            bias,
            bias_sigma: (variance / differences.len() as f64).sqrt(),
            psnr: psnr(test, reference),
            ssim: crate::ssim(test, reference)?,
            #[cfg(feature = "flip")]
            flip: crate::flip(test, reference)?,
        })
    }
}

fn psnr(test: &Image<'_>, reference: &Image<'_>) -> f64 {
    let (test, reference) = (display_values(test), display_values(reference));
    let squares = test.as_flattened().iter().zip(reference.as_flattened());
    -10.0 * mean(squares.map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2))).log10()
}

/// Returns the mean; NaN if there are no values.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / count
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    const WIDTH: usize = 40;
    const HEIGHT: usize = 30;

    fn picture() -> Vec<[f32; 3]> {
        (0..WIDTH * HEIGHT)
            .map(|i| {
                let (x, y) = ((i % WIDTH) as f32, (i / WIDTH) as f32);
                [0.4 + 0.3 * (x * 0.7).sin(), 0.3 + 0.2 * (y * 0.5).cos(), 0.2 + 0.005 * x]
            })
            .collect()
    }

    fn measure(test: &[[f32; 3]], reference: &[[f32; 3]]) -> ImageError {
        let [test, reference] =
            [test, reference].map(|pixels| Image::new(WIDTH, HEIGHT, pixels).expect("sizes fit"));
        ImageError::measure(&test, &reference).expect("comparable")
    }

    #[test]
    fn equal_images_have_no_error() {
        let picture = picture();
        let error = measure(&picture, &picture);
        assert_eq!((error.mae, error.rmse, error.relmse, error.bias), (0.0, 0.0, 0.0, 0.0));
        assert_eq!(error.psnr, f64::INFINITY);
        assert_abs_diff_eq!(error.ssim, 1.0, epsilon = 1e-12);
        #[cfg(feature = "flip")]
        assert_eq!(error.flip.max, 0.0);
    }

    #[test]
    fn a_constant_offset_has_closed_forms() {
        let grey = vec![[0.5; 3]; WIDTH * HEIGHT];
        let brighter = vec![[0.75; 3]; WIDTH * HEIGHT];
        let error = measure(&brighter, &grey);
        assert_eq!((error.mae, error.mse, error.rmse, error.bias), (0.25, 0.0625, 0.25, 0.25));
        assert_eq!(error.bias_sigma, 0.0);
        assert_abs_diff_eq!(error.relmse, 0.0625 / 0.26, epsilon = 1e-12);
        // sRGB of .5 and .75 is .735357 and .880825.
        assert!((error.psnr + 20.0 * (0.880_825_f64 - 0.735_357).log10()).abs() < 1e-3, "{}", error.psnr);
    }

    #[test]
    fn one_wrong_pixel_is_seen_by_every_figure() {
        let picture = picture();
        let mut wrong = picture.clone();
        wrong[WIDTH * 15 + 20] = [1.0, 0.0, 1.0];
        let error = measure(&wrong, &picture);
        for (name, value) in [
            ("mae", error.mae),
            ("rmse", error.rmse),
            ("relmse", error.relmse),
            ("bias", error.bias.abs()),
            ("1 - ssim", 1.0 - error.ssim),
        ] {
            assert!(value > 1e-5, "{name} = {value}");
        }
        assert!(error.psnr < 60.0);
        // The trimmed figure leaves out three of 3,600 terms, which are those of this pixel.
        assert_eq!(error.relmse_trimmed, 0.0);
        #[cfg(feature = "flip")]
        assert!(error.flip.max > 0.2 && error.flip.mean > 1e-4 && error.flip.mean < 0.1, "{:?}", error.flip);
    }

    #[test]
    fn pixels_that_are_not_finite_are_counted() {
        let picture = picture();
        let mut wrong = picture.clone();
        wrong[5][1] = f32::NAN;
        wrong[6][0] = f32::INFINITY;
        let error = measure(&wrong, &picture);
        assert_eq!((error.non_finite, error.mae), (2, 0.0));
        assert!(error.psnr.is_finite() && error.ssim < 1.0);
        let [bad, good] = [&wrong, &picture].map(|p| Image::new(WIDTH, HEIGHT, p).expect("sizes fit"));
        let refused = ImageError::measure(&good, &bad);
        assert_eq!(refused, Err(MetricsError::NonFiniteReference { pixel: 5 }));
    }

    #[test]
    fn sizes_are_checked() {
        let picture = picture();
        for (width, height) in [(0, 0), (WIDTH, HEIGHT + 1), (usize::MAX, 2)] {
            assert!(Image::new(width, height, &picture).is_err());
        }
        assert!(Image::new(0, 0, &[]).is_err());
        let wide = Image::new(WIDTH, HEIGHT, &picture).expect("sizes fit");
        let tall = Image::new(HEIGHT, WIDTH, &picture).expect("sizes fit");
        assert!(matches!(ImageError::measure(&wide, &tall), Err(MetricsError::SizeMismatch { .. })));
    }
}

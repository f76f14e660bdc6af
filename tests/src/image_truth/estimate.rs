//! Estimate: a mean with its standard error, and the one bound with which all closed forms are checked.

use std::sync::atomic::{AtomicUsize, Ordering};

/// Largest error of an estimate, in standard errors. All checks of one run together, at most [`CHECK_LIMIT`]
/// of them, refuse a right program with a probability below 1e-6: Student's distribution with the
/// [`Estimate::PIXELS`] degrees of freedom that every estimate has at least puts 2.7e-9 beyond this bound.
pub const SIGMAS: f64 = 6.0;

/// Largest number of checks, each of one channel, that the family-wise bound of [`SIGMAS`] covers.
pub const CHECK_LIMIT: usize = 350;

/// Number of checks of this program so far.
static CHECKS: AtomicUsize = AtomicUsize::new(0);

/// Relative error of an estimate by single precision: sums of some thousand terms.
const ROUNDING: f64 = 1e-5;

/// Mean of an image by channel, with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Mean over pixels and samples.
    pub mean: [f64; 3],
    /// Standard error of `mean`.
    pub sigma: [f64; 3],
}

impl Estimate {
    /// Least number of pixels of an image: the degrees of freedom of its standard error.
    pub const PIXELS: usize = 1024;

    /// Makes the estimate from two images of one view with different samples. Pixels may differ from each
    /// other: the error is computed from the differences of each pixel between the two images.
    ///
    /// # Panics
    /// If the sizes differ or there are fewer than [`Estimate::PIXELS`] pixels.
    pub fn of_pair(first: &[[f32; 3]], second: &[[f32; 3]]) -> Self {
        assert_eq!(first.len(), second.len(), "both images show the same view");
        assert!(first.len() >= Self::PIXELS, "{} pixels are too few for the bound", first.len());
        let doubled = 2.0 * first.len() as f64;
        let sum = |channel: usize, term: fn(f64, f64) -> f64| -> f64 {
            let pairs = first.iter().zip(second);
            pairs.map(|(a, b)| term(f64::from(a[channel]), f64::from(b[channel]))).sum()
        };
        Self {
            mean: std::array::from_fn(|channel| sum(channel, |a, b| a + b) / doubled),
            // The variance of a pixel's mean over both images is a quarter of (a - b)^2.
            sigma: std::array::from_fn(|channel| sum(channel, |a, b| (a - b) * (a - b)).sqrt() / doubled),
        }
    }

    /// Returns the distance of the worst channel from the truth, beyond the tolerance of `slack` (a share of
    /// the truth) and rounding, in standard errors; infinite if nothing varies and the value is wrong.
    pub fn deviation(&self, truth: [f64; 3], slack: f64) -> f64 {
        let channel = |c: usize| {
            let beyond = (self.mean[c] - truth[c]).abs() - (slack + ROUNDING) * truth[c].abs();
            // The comparison is written so that NaN is infinitely wrong.
            if beyond <= 0.0 {
                0.0
            } else if self.sigma[c] > 0.0 && beyond.is_finite() {
                beyond / self.sigma[c]
            } else {
                f64::INFINITY
            }
        };
        (0..3).map(channel).fold(0.0, f64::max)
    }
}

/// Fails unless the estimate is within [`SIGMAS`] standard errors of the truth; `slack` (a share of the
/// truth) is the error that the structure's own law allows.
///
/// # Panics
/// If the estimate is farther off.
#[track_caller]
pub fn assert_truth(name: &str, estimate: &Estimate, truth: [f64; 3], slack: f64) {
    let checks = CHECKS.fetch_add(1, Ordering::Relaxed) + 1;
    assert!(
        checks <= CHECK_LIMIT,
        "{name}: check {checks} of this program is beyond the {CHECK_LIMIT} that the bound covers"
    );
    let deviation = estimate.deviation(truth, slack);
    eprintln!(
        "{name}: {:.6?}, truth {truth:.6?}, sigma {:.6?}: {deviation:.2} sigma",
        estimate.mean, estimate.sigma
    );
    assert!(deviation <= SIGMAS, "{name}: {deviation} sigma from {truth:?}: {estimate:?}");
}

/// Fails unless the check that a right variant passes detects a broken variant.
///
/// # Panics
/// If the estimate would pass as the truth.
#[track_caller]
pub fn assert_refused(name: &str, broken: &Estimate, truth: [f64; 3], slack: f64) {
    let deviation = broken.deviation(truth, slack);
    eprintln!("{name}: broken: {:.6?}, {deviation:.2} sigma", broken.mean);
    assert!(deviation > SIGMAS, "{name}: would pass as {truth:?}: {broken:?}");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn noise(seed: u64, mean: f32) -> Vec<[f32; 3]> {
        let mut random = Random::new(seed);
        // Pixels differ in brightness, each with noise of its own.
        (0..1024).map(|i| [mean * (i % 7) as f32 / 3.0 + random.between(-0.5, 0.5); 3]).collect()
    }

    #[test]
    fn the_error_of_the_mean_is_that_of_many_repetitions() {
        let estimates: Vec<Estimate> =
            (0..400).map(|i| Estimate::of_pair(&noise(2 * i, 1.0), &noise(2 * i + 1, 1.0))).collect();
        let mean = estimates.iter().map(|e| e.mean[0]).sum::<f64>() / 400.0;
        let spread = (estimates.iter().map(|e| (e.mean[0] - mean).powi(2)).sum::<f64>() / 399.0).sqrt();
        let claimed = estimates.iter().map(|e| e.sigma[0]).sum::<f64>() / 400.0;
        // The spread of 400 means is known to 3.5 percent.
        assert!((spread / claimed - 1.0).abs() < 0.15, "{spread} {claimed}");
        // Uniform noise of width 1 has the variance 1/12.
        let expected = (1.0 / 12.0 / 2048.0_f64).sqrt();
        assert!((claimed / expected - 1.0).abs() < 0.02, "{claimed} {expected}");
    }

    #[test]
    fn wrong_nan_and_noiseless_values_are_told_apart() {
        let exact = Estimate { mean: [1.0; 3], sigma: [0.0; 3] };
        assert_eq!(exact.deviation([1.0; 3], 0.0), 0.0);
        assert_eq!(exact.deviation([1.0, 1.0, 1.001], 0.0), f64::INFINITY);
        assert_eq!(exact.deviation([1.0, 1.0, 1.001], 0.01), 0.0);
        let nan = Estimate { mean: [1.0, f64::NAN, 1.0], sigma: [0.1; 3] };
        assert_eq!(nan.deviation([1.0; 3], 0.0), f64::INFINITY);
        let unsure = Estimate { mean: [1.7; 3], sigma: [0.1; 3] };
        assert!((unsure.deviation([1.0; 3], 0.0) - 7.0).abs() < 0.01);
    }
}

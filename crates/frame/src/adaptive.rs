//! Adaptive sampling: gives each pixel a number of samples that depends on the noise of its neighbours.
//!
//! A pixel that stops by its own samples is biased: it stops early if it happened to miss a rare, bright
//! contribution (Kirk and Arvo 1991). Here the pilot, the first few samples of every pixel, determines the
//! need of each pixel from the samples of its neighbours, never from its own. Random numbers of different
//! pixels are independent, so the number of a pixel's samples is independent of their values, and their mean
//! is as unbiased as that of any fixed number. No sample is thrown away, and the noise estimate rests on
//! eight times as many samples. The numbers are decided once: a second decision would see samples whose
//! number the pixel itself influenced.

use rasray_integrators::FilmPixel;

use crate::moments::Moments;

/// Weights of red, green and blue in the luminance, by Rec. 709.
const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Share of the picture's mean luminance below which a pixel counts as dark: a darker pixel is allowed the
/// noise of a pixel with this luminance.
const DARK: f64 = 0.1;

/// Rule of adaptive sampling: the permitted noise and the size of the pilot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptive {
    /// Permitted standard error of the mean of a pixel, as a share of its luminance, or of a tenth of the
    /// picture's mean luminance if the pixel is darker. With 0 every pixel with any noise around it gets all
    /// samples.
    pub threshold: f64,
    /// Number of samples of the pilot, which every pixel gets: at least 2.
    pub least: u32,
}

/// Pilot of an image: statistics of the first samples of each pixel.
#[derive(Clone, Debug)]
pub(crate) struct Pilot {
    width: usize,
    /// Mean and variance of each pixel's luminance.
    pixels: Vec<Moments>,
}

impl Pilot {
    /// Makes a pilot without samples, for an image with `width` pixels in a row and `pixels` in all.
    pub fn new(width: u32, pixels: u32) -> Self {
        Self { width: width as usize, pixels: vec![Moments::default(); pixels as usize] }
    }

    /// Takes in the sample that was added to each pixel of a band of the film since the previous call;
    /// `first` is the first pixel of the band. A sample that is not finite is not on the film and changes
    /// nothing.
    pub fn add(&mut self, first: u32, film: &[FilmPixel]) {
        for (moments, pixel) in self.pixels.iter_mut().skip(first as usize).zip(film) {
            let summed: f64 =
                pixel.sum.iter().zip(LUMINANCE).map(|(sum, weight)| f64::from(*sum) * weight).sum();
            moments.follow(summed, pixel.samples);
        }
    }

    /// Returns the number of samples of each pixel, from that of the pilot to `most`, judged by its
    /// neighbours.
    pub fn counts(&self, rule: Adaptive, most: u32) -> Vec<u32> {
        self.counts_by(rule, most, |pixel| self.neighbours(pixel))
    }

    /// Returns the number of samples of each pixel, from that of the pilot to `most`, judged by the pixels
    /// that `judged_by` returns for it.
    fn counts_by<N: Iterator<Item = usize>>(
        &self,
        rule: Adaptive,
        most: u32,
        judged_by: impl Fn(usize) -> N,
    ) -> Vec<u32> {
        let total: f64 = self.pixels.iter().map(|moments| f64::from(moments.mean)).sum();
        let count = |(place, own): (usize, &Moments)| {
            // The mean excludes the pixel's own part, like all other values by which the pixel is judged.
            let others = (total - f64::from(own.mean)) / (self.pixels.len() - 1).max(1) as f64;
            let noise = |moments: &Moments| {
                let mean = f64::from(moments.mean).max(DARK * others);
                moments
                    .variance()
                    .map(|variance| if variance == 0.0 { 0.0 } else { variance / (mean * mean) })
            };
            let (mut sum, mut known) = (0.0, 0.0);
            for of_other in judged_by(place).filter_map(|other| noise(&self.pixels[other])) {
                sum += of_other;
                known += 1.0;
            }
            // Without noise no further sample is wanted, even if `threshold` is 0. If the noise is unknown,
            // all samples are wanted.
            let wanted = if sum == 0.0 && known > 0.0 { 0.0 } else { sum / known / rule.threshold.powi(2) };
            needed(wanted, rule.least, most)
        };
        self.pixels.iter().enumerate().map(count).collect()
    }

    /// Returns the neighbours of a pixel, up to eight.
    fn neighbours(&self, pixel: usize) -> impl Iterator<Item = usize> {
        let (width, height) = (self.width, self.pixels.len() / self.width);
        let (column, row) = (pixel % width, pixel / width);
        let around = move |place: usize, end: usize| place.saturating_sub(1)..(place + 2).min(end);
        around(row, height)
            .flat_map(move |y| around(column, width).map(move |x| y * width + x))
            .filter(move |other| *other != pixel)
    }
}

/// Rounds the wanted number of samples up and clamps it to `least..=most`; NaN gives `most`.
fn needed(wanted: f64, least: u32, most: u32) -> u32 {
    if wanted.is_nan() { most } else { (wanted.ceil() as u32).clamp(least.min(most), most) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Makes a film of one row with the given sums and number of samples per pixel.
    fn film(sums: &[f64], samples: u32) -> Vec<FilmPixel> {
        sums.iter().map(|sum| FilmPixel { sum: [*sum as f32; 3], samples }).collect()
    }

    /// Makes a pilot whose samples `value` returns by pixel and sample.
    fn pilot(width: u32, pixels: u32, samples: u32, value: impl Fn(u32, u32) -> f64) -> Pilot {
        let mut pilot = Pilot::new(width, pixels);
        let mut sums = vec![0.0; pixels as usize];
        for sample in 0..samples {
            for (pixel, sum) in (0..).zip(&mut sums) {
                *sum += value(pixel, sample);
            }
            pilot.add(0, &film(&sums, sample + 1));
        }
        pilot
    }

    /// Returns a pseudorandom number from 0 to 1 for the given words.
    fn random(words: [u32; 3]) -> f64 {
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        for word in words {
            state = (state ^ u64::from(word)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            state ^= state >> 29;
        }
        state = (state ^ (state >> 32)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Samples that are 0 except for one in twelve: a rare, bright contribution.
    fn rare(seed: u32) -> impl Fn(u32, u32) -> f64 {
        move |pixel, sample| if random([seed, pixel, sample]) < 1.0 / 12.0 { 12.0 } else { 0.0 }
    }

    #[test]
    fn neighbours_are_those_around_within_the_image() {
        let of = |pixel| Pilot::new(4, 12).neighbours(pixel).collect::<Vec<_>>();
        assert_eq!(of(5), [0, 1, 2, 4, 6, 8, 9, 10]);
        assert_eq!(of(0), [1, 4, 5]);
        assert_eq!(of(11), [6, 7, 10]);
        assert_eq!(Pilot::new(1, 1).neighbours(0).count(), 0);
        assert_eq!(Pilot::new(1, 3).neighbours(1).collect::<Vec<_>>(), [0, 2]);
    }

    #[test]
    fn moments_are_mean_and_variance() {
        let known = pilot(1, 1, 4, |_, sample| [1.0, 2.0, 4.0, 5.0][sample as usize]);
        let moments = known.pixels[0];
        assert!((f64::from(moments.mean) - 3.0).abs() < 1e-6);
        assert!((moments.variance().expect("four samples") - 10.0 / 3.0).abs() < 1e-6);
        assert_eq!(pilot(1, 1, 1, |_, _| 1.0).pixels[0].variance(), None);
    }

    #[test]
    fn a_pixel_gets_what_its_neighbours_need_and_its_own_samples_decide_nothing() {
        let rule = Adaptive { threshold: 0.1, least: 4 };
        // The samples of all pixels of one row are 0.5 and 1.5 in turn; those of pixel 2 are `own`.
        let with_own = |own: f64| {
            let value = move |pixel, sample| if pixel == 2 { own } else { 0.5 + f64::from(sample % 2) };
            pilot(6, 6, 4, value).counts(rule, 1000)
        };
        // The variance of four such samples is 1/3, and 33.3 of them have a standard error of a tenth.
        let counts = with_own(1.0);
        assert_eq!((counts[0], counts[2], counts[4], counts[5]), (34, 34, 34, 34));
        assert_eq!(counts[3], 17, "one of its two neighbours has no noise");
        for own in [0.0, 1.0e6] {
            assert_eq!(with_own(own)[2], 34);
        }
    }

    #[test]
    fn counts_stay_between_the_pilot_and_the_most_whatever_the_samples_are() {
        let rule = Adaptive { threshold: 0.1, least: 4 };
        let counts = |most, value: fn(u32, u32) -> f64| pilot(3, 9, 4, value).counts(rule, most);
        assert_eq!(counts(64, |_, _| 0.0), [4; 9], "black");
        assert_eq!(counts(64, |_, _| 7.5), [4; 9], "without noise");
        assert_eq!(counts(64, |_, sample| 1.0e20 * f64::from(sample % 2)), [64; 9]);
        assert_eq!(counts(2, |_, sample| f64::from(sample)), [2; 9], "fewer than the pilot's");
        let exact = Adaptive { threshold: 0.0, ..rule };
        assert_eq!(pilot(3, 9, 4, |_, sample| f64::from(sample)).counts(exact, 64), [64; 9]);
        assert_eq!(pilot(1, 1, 4, |_, _| 1.0).counts(rule, 64), [64], "without neighbours nothing is known");
        // The film does not take samples that are not finite.
        let mut unknown = Pilot::new(3, 9);
        unknown.add(0, &film(&[0.0; 9], 0));
        assert_eq!(unknown.counts(rule, 64), [64; 9]);
    }

    #[test]
    fn dark_pixels_are_allowed_the_noise_of_a_tenth_of_the_picture() {
        // The left half is 1000 without noise, the right half about 1: its noise of a half is far below the
        // threshold, because those pixels are dark.
        let value = |pixel, sample| if pixel % 8 < 4 { 1000.0 } else { 0.5 + f64::from(sample % 2) };
        let counts = pilot(8, 64, 4, value).counts(Adaptive { threshold: 0.1, least: 4 }, 64);
        assert_eq!(counts, [4; 64]);
    }

    /// Returns the mean of all pixels of `seeds` images and its standard error; the numbers of samples are
    /// decided by a pixel's `own` samples or by those of its neighbours. The true mean is 1.
    fn mean_of_images(seeds: u32, own: bool) -> (f64, f64) {
        let (width, pixels) = (6, 36);
        let rule = Adaptive { threshold: 0.5, least: 8 };
        let image = |seed| {
            let value = rare(seed);
            let pilot = pilot(width, pixels, rule.least, &value);
            let counts = match own {
                true => pilot.counts_by(rule, 64, std::iter::once),
                false => pilot.counts(rule, 64),
            };
            let mean = |(pixel, count): (u32, &u32)| {
                (0..*count).map(|sample| value(pixel, sample)).sum::<f64>() / f64::from(*count)
            };
            (0..).zip(&counts).map(mean).sum::<f64>() / f64::from(pixels)
        };
        let images: Vec<f64> = (0..seeds).map(image).collect();
        let mean = images.iter().sum::<f64>() / f64::from(seeds);
        let squares: f64 = images.iter().map(|image| (image - mean).powi(2)).sum();
        (mean, (squares / f64::from(seeds - 1) / f64::from(seeds)).sqrt())
    }

    #[test]
    fn means_are_unbiased_and_would_not_be_if_pixels_were_judged_by_their_own_samples() {
        let (mean, error) = mean_of_images(2000, false);
        assert!((mean - 1.0).abs() < 3.0 * error, "{mean} +- {error}");
        // The naive rule stops if no bright sample was met: half of the pixels stop so and stay black.
        let (naive, error) = mean_of_images(2000, true);
        assert!(naive < 1.0 - 20.0 * error && naive < 0.9, "{naive} +- {error}");
    }
}

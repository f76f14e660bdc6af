//! Mean and variance of the samples of pixels, from a film that is read after each of them.

use rasray_integrators::FilmPixel;

/// The samples of a pixel: mean and summed squares of what differs from it, by Welford's recurrence.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moments {
    /// Number of samples.
    pub samples: u32,
    /// Mean of all samples.
    pub mean: f32,
    squares: f32,
    /// The film's sum.
    summed: f32,
}

impl Moments {
    /// Takes in the sample that was added to the film's sum since the call before; one that is not finite was
    /// not.
    pub fn follow(&mut self, summed: f64, samples: u32) {
        if samples > self.samples {
            self.add(summed - f64::from(self.summed));
        }
        self.summed = summed as f32;
    }

    fn add(&mut self, value: f64) {
        self.samples += 1;
        let before = value - f64::from(self.mean);
        let mean = f64::from(self.mean) + before / f64::from(self.samples);
        self.mean = mean as f32;
        self.squares += (before * (value - mean)) as f32;
    }

    /// Unbiased variance of a sample; absent where there are fewer than two.
    pub fn variance(&self) -> Option<f64> {
        (self.samples > 1).then(|| f64::from(self.squares) / f64::from(self.samples - 1))
    }
}

/// The samples of each pixel of a film, channel by channel.
#[derive(Clone, Debug)]
pub(crate) struct Variances(Vec<[Moments; 3]>);

impl Variances {
    /// Nothing is known of an image with so many pixels.
    pub fn new(pixels: u32) -> Self {
        Self(vec![[Moments::default(); 3]; pixels as usize])
    }

    /// Takes in the sample that was added to pixels of a band of the film, from pixel `first` on, since the
    /// call before.
    pub fn add(&mut self, first: u32, film: &[FilmPixel]) {
        for (channels, pixel) in self.0.iter_mut().skip(first as usize).zip(film) {
            for (moments, sum) in channels.iter_mut().zip(pixel.sum) {
                moments.follow(sum.into(), pixel.samples);
            }
        }
    }

    /// Variance of the mean of each pixel, as if its samples were independent: the variance of a sample over
    /// the number of samples; 0 where there are fewer than two.
    pub fn of_means(&self) -> impl Iterator<Item = [f32; 3]> {
        let of_mean =
            |moments: Moments| (moments.variance().unwrap_or(0.0) / f64::from(moments.samples.max(1))) as f32;
        self.0.iter().map(move |channels| channels.map(of_mean))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variances_are_those_of_the_mean_and_samples_that_were_left_out_do_not_count() {
        let mut variances = Variances::new(2);
        let mut film = [FilmPixel::default(); 2];
        // The second pixel is of a band of its own.
        let add = |variances: &mut Variances, film: &[FilmPixel]| {
            (0..).zip(film.chunks(1)).for_each(|(first, band)| variances.add(first, band));
        };
        for sample in [1.0_f32, 2.0, 4.0, 5.0] {
            film[0].sum = film[0].sum.map(|sum| sum + sample);
            film[0].samples += 1;
            add(&mut variances, &film);
            // Pixels that got no sample this time.
            add(&mut variances, &film);
        }
        film[1] = FilmPixel { sum: [3.0; 3], samples: 1 };
        add(&mut variances, &film);
        film[1] = FilmPixel { sum: [8.0; 3], samples: 2 };
        add(&mut variances, &film);
        let [first, second] = variances.of_means().collect::<Vec<_>>()[..] else { panic!("two pixels") };
        assert!(first.iter().all(|value| (value - 10.0 / 12.0).abs() < 1.0e-6), "{first:?}");
        assert_eq!(second, [1.0; 3], "2 / 2 of the samples 3 and 5");
        assert_eq!(Variances::new(1).of_means().next(), Some([0.0; 3]));
    }
}

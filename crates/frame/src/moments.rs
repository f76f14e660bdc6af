//! Mean and variance of the samples of pixels, from a film that is read after each sample.

use rasray_integrators::FilmPixel;

/// Mean of a pixel's samples and sum of the squared differences from it, by Welford's recurrence.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moments {
    /// Number of samples.
    pub samples: u32,
    /// Mean of all samples.
    pub mean: f32,
    squares: f32,
    /// Sum of the samples on the film.
    summed: f32,
}

impl Moments {
    /// Takes in the sample that was added to the film's sum since the previous call. A sample that is not
    /// finite is not on the film and changes nothing.
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

    /// Returns the unbiased variance of a sample; absent if there are fewer than two samples.
    pub fn variance(&self) -> Option<f64> {
        (self.samples > 1).then(|| f64::from(self.squares) / f64::from(self.samples - 1))
    }
}

/// Moments of each pixel of a film, channel by channel.
#[derive(Clone, Debug)]
pub(crate) struct Variances(Vec<[Moments; 3]>);

impl Variances {
    /// Makes moments without samples, for an image with `pixels` pixels.
    pub fn new(pixels: u32) -> Self {
        Self(vec![[Moments::default(); 3]; pixels as usize])
    }

    /// Takes in the sample that was added to pixels of a band of the film since the previous call; `first` is
    /// the first pixel of the band.
    pub fn add(&mut self, first: u32, film: &[FilmPixel]) {
        for (channels, pixel) in self.0.iter_mut().skip(first as usize).zip(film) {
            for (moments, sum) in channels.iter_mut().zip(pixel.sum) {
                moments.follow(sum.into(), pixel.samples);
            }
        }
    }

    /// Returns the variance of the mean of each pixel, as if its samples were independent: the variance of a
    /// sample divided by the number of samples; 0 if there are fewer than two.
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
        // The second pixel is in a band of its own.
        let add = |variances: &mut Variances, film: &[FilmPixel]| {
            (0..).zip(film.chunks(1)).for_each(|(first, band)| variances.add(first, band));
        };
        for sample in [1.0_f32, 2.0, 4.0, 5.0] {
            film[0].sum = film[0].sum.map(|sum| sum + sample);
            film[0].samples += 1;
            add(&mut variances, &film);
            // The film does not change, as for pixels that got no sample.
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

//! Bands: the division of an image's pixels among buffers.

use std::ops::Range;

use rasray_gpu::Device;
use rasray_shaders_glsl::records::AovPixel;

use crate::{IntegratorError, Wave};

/// Maximum number of pixels of an image: indices of pixels, and of their three channels, fit in 32 bits.
pub const PIXEL_LIMIT: u32 = 1 << 30;

/// Bytes of the larger of the two records per pixel: that of a film and that of the images beside it.
const RECORD_BYTES: u64 = size_of::<AovPixel>() as u64;

/// Bands of an image: consecutive pixels whose records are in one buffer, as many as a device can bind. All
/// but the last have equally many pixels. A wave lies in one band; pictures do not depend on the borders of
/// bands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bands {
    pixels: u32,
    /// Number of pixels of each band but the last: at least 1.
    most: u32,
}

impl Bands {
    /// Makes as few bands as the device allows.
    ///
    /// # Errors
    /// `ImageSize` for an image without pixels or with too many.
    pub fn new(device: &Device, [width, height]: [u32; 2]) -> Result<Self, IntegratorError> {
        Ok(Self::one([width, height])?.of_records(device, RECORD_BYTES))
    }

    /// Returns bands of at most as many pixels as fit into one binding of the device with records of
    /// `record_bytes` bytes, at least 1.
    #[must_use]
    pub(crate) fn of_records(self, device: &Device, record_bytes: u64) -> Self {
        let limits = device.limits();
        let bytes = limits.max_storage_buffer_range.min(limits.max_memory_allocation);
        self.at_most(u32::try_from(bytes / record_bytes).unwrap_or(u32::MAX))
    }

    /// Makes one band for all pixels, whether or not a device can bind it.
    ///
    /// # Errors
    /// Errors of [`Bands::new`].
    pub(crate) fn one([width, height]: [u32; 2]) -> Result<Self, IntegratorError> {
        match width.checked_mul(height) {
            Some(pixels) if pixels > 0 && pixels <= PIXEL_LIMIT => Ok(Self { pixels, most: pixels }),
            _ => Err(IntegratorError::ImageSize { width, height, limit: PIXEL_LIMIT }),
        }
    }

    /// Returns bands of at most `most` pixels, at least 1.
    #[must_use]
    pub fn at_most(self, most: u32) -> Self {
        Self { most: self.most.min(most).max(1), ..self }
    }

    /// Returns the number of pixels in all.
    pub fn pixel_count(self) -> u32 {
        self.pixels
    }

    /// Returns the largest number of pixels of a band.
    pub(crate) fn most(self) -> u32 {
        self.most
    }

    /// Returns the band of a pixel.
    pub(crate) fn of(self, pixel: u32) -> usize {
        (pixel / self.most) as usize
    }

    /// Iterates over the ranges of pixel numbers of the bands.
    pub fn ranges(self) -> impl Iterator<Item = Range<u32>> + Clone {
        (0..self.pixels.div_ceil(self.most)).map(move |band| {
            let first = band * self.most;
            first..first + self.most.min(self.pixels - first)
        })
    }

    /// Cuts samples with these indices into waves of at most `capacity` pixels: all pixels of a sample before
    /// the next sample starts, so that a picture stopped early has the same number of samples everywhere.
    pub fn waves(self, samples: impl IntoIterator<Item = u32>, capacity: u32) -> impl Iterator<Item = Wave> {
        let of_sample = move |sample| self.ranges().flat_map(move |band| Wave::cut(band, sample, capacity));
        samples.into_iter().flat_map(of_sample)
    }

    /// Returns an error unless the wave lies in one band and has no more pixels than slots.
    pub(crate) fn check(self, wave: Wave, capacity: u32) -> Result<(), IntegratorError> {
        if wave.pixel_count == 0 || wave.pixel_count > capacity {
            return Err(IntegratorError::WaveSize { wave, capacity });
        }
        match wave.first_pixel.checked_add(wave.pixel_count) {
            Some(end) if end > self.pixels => {
                Err(IntegratorError::WaveOutsideImage { wave, pixels: self.pixels })
            }
            Some(end) if self.of(end - 1) == self.of(wave.first_pixel) => Ok(()),
            Some(_) => Err(IntegratorError::WaveOfTwoBands { wave, most: self.most }),
            None => Err(IntegratorError::WaveOutsideImage { wave, pixels: self.pixels }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::WAVE_LIMIT;

    fn bands(pixels: u32, most: u32) -> Bands {
        Bands { pixels, most: pixels }.at_most(most)
    }

    #[test]
    fn impossible_images_are_refused() {
        assert_eq!(Bands::one([640, 360]).ok(), Some(Bands { pixels: 230_400, most: 230_400 }));
        for size in [[0, 5], [5, 0], [65_536, 65_536], [1 << 20, 1 << 11]] {
            assert!(matches!(Bands::one(size), Err(IntegratorError::ImageSize { .. })));
        }
    }

    #[test]
    fn every_pixel_is_in_the_band_that_is_said_to_hold_it() {
        for (pixels, most, count) in
            [(1, 1, 1), (10, 4, 3), (12, 4, 3), (10, 0, 10), (10, u32::MAX, 1), (PIXEL_LIMIT, 1 << 26, 16)]
        {
            let bands = bands(pixels, most);
            let mut end = 0;
            for (number, range) in bands.ranges().enumerate() {
                assert_eq!(range.start, end);
                assert_eq!([range.start, range.end - 1].map(|pixel| bands.of(pixel)), [number; 2]);
                end = range.end;
            }
            assert_eq!((end, bands.ranges().count()), (pixels, count));
        }
    }

    #[test]
    fn every_pixel_of_every_sample_is_in_exactly_one_wave() {
        for (pixels, most, samples, capacity) in [
            (1, 1, 1, 1),
            (10, 10, 2, 3),
            (10, 4, 2, 3),
            (10, 3, 2, 4),
            (WAVE_LIMIT + 1, u32::MAX, 2, u32::MAX),
            (7, 7, 0, 3),
            (4, 4, 4, 0),
        ] {
            let bands = bands(pixels, most);
            let mut seen = vec![0u32; pixels as usize * samples as usize];
            for wave in bands.waves(0..samples, capacity) {
                assert!(bands.check(wave, capacity.clamp(1, WAVE_LIMIT)).is_ok(), "{wave:?}");
                for pixel in wave.first_pixel..wave.first_pixel + wave.pixel_count {
                    seen[(wave.sample * pixels + pixel) as usize] += 1;
                }
            }
            assert!(seen.iter().all(|&count| count == 1));
        }
    }

    #[test]
    fn samples_are_taken_one_after_the_other() {
        let samples = |bands: Bands, samples: &[u32]| {
            bands.waves(samples.to_vec(), 4).map(|wave| wave.sample).collect::<Vec<_>>()
        };
        assert_eq!(samples(bands(10, 10), &[0, 1, 2]), [0, 0, 0, 1, 1, 1, 2, 2, 2]);
        assert_eq!(samples(bands(5, 5), &[1, 3]), [1, 1, 3, 3]);
        assert_eq!(samples(bands(5, 3), &[1, 3]), [1, 1, 3, 3]);
    }

    #[test]
    fn waves_that_do_not_fit_are_refused() {
        let wave = |first_pixel, pixel_count| Wave { first_pixel, pixel_count, sample: 0 };
        let whole = bands(16, 16);
        assert!(whole.check(wave(0, 8), 8).is_ok() && whole.check(wave(8, 8), 8).is_ok());
        for count in [0, 9] {
            assert!(matches!(whole.check(wave(0, count), 8), Err(IntegratorError::WaveSize { .. })));
        }
        for first in [9, u32::MAX] {
            let outside = whole.check(wave(first, 8), 8);
            assert!(matches!(outside, Err(IntegratorError::WaveOutsideImage { .. })));
        }
        let halves = bands(16, 8);
        assert!(halves.check(wave(8, 8), 8).is_ok());
        assert!(matches!(halves.check(wave(7, 2), 8), Err(IntegratorError::WaveOfTwoBands { .. })));
    }
}

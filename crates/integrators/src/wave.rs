//! Waves: how the pixels of an image are cut into dispatches.

use rasray_ads::Surface;
use rasray_gpu::Device;

/// Maximum number of rays in a wave. Bounds the memory of queues and path states.
pub const WAVE_LIMIT: u32 = 1 << 20;

/// Rays in a wave on software drivers, whose dispatches take long, and on devices with little memory.
const SMALL_WAVE: u32 = 131_072;

/// Bytes per slot of two queues and a path's state, rounded up.
const SLOT_BYTES: u64 = 512;

/// Number of rays in a wave, by device: 131,072 on software drivers; on others as many as fit into a sixteenth of the
/// device's memory and into one binding, at most [`WAVE_LIMIT`]. No picture depends on it.
pub fn wave_capacity(device: &Device) -> u32 {
    let limits = device.limits();
    suitable(device.is_software(), limits.device_local_bytes, limits.max_storage_buffer_range)
}

fn suitable(software: bool, memory: u64, binding: u64) -> u32 {
    if software {
        return SMALL_WAVE;
    }
    let slots = (memory / 16 / SLOT_BYTES).min(binding / size_of::<Surface>() as u64);
    slots.clamp(SMALL_WAVE.into(), WAVE_LIMIT.into()) as u32
}

/// A range of pixels of which one sample is taken. Pixels are numbered row by row from the top left;
/// slot `i` of the queues holds the ray of pixel `first_pixel + i`, or of the pixel at that place of the film's list
/// ([`Film::listed`](crate::Film::listed)).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wave {
    /// Number of the first pixel in the whole image, or its place in the list.
    pub first_pixel: u32,
    /// Pixels in the wave, at least 1, at most the capacity of the queues.
    pub pixel_count: u32,
    /// Index of the sample. Random numbers depend on it and on the pixel, never on the wave, so
    /// that the picture is the same however the image is cut.
    pub sample: u32,
}

/// Cuts every sample of `pixels` pixels into waves of at most `capacity`: all pixels of a sample
/// before the next sample starts, so that a picture stopped early has the same number of samples everywhere.
pub fn waves(pixels: u32, samples: u32, capacity: u32) -> impl Iterator<Item = Wave> {
    waves_of(pixels, 0..samples, capacity)
}

/// The same for samples with these indices, in their order.
pub fn waves_of(
    pixels: u32,
    samples: impl IntoIterator<Item = u32>,
    capacity: u32,
) -> impl Iterator<Item = Wave> {
    let capacity = capacity.clamp(1, WAVE_LIMIT);
    samples.into_iter().flat_map(move |sample| {
        (0..pixels.div_ceil(capacity)).map(move |number| {
            let first_pixel = number * capacity;
            Wave { first_pixel, pixel_count: capacity.min(pixels - first_pixel), sample }
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_of_every_sample_is_in_exactly_one_wave() {
        for (pixels, samples, capacity) in
            [(1, 1, 1), (10, 2, 3), (WAVE_LIMIT + 1, 2, u32::MAX), (7, 0, 3), (0, 4, 8)]
        {
            let mut seen = vec![0u32; pixels as usize * samples as usize];
            for wave in waves(pixels, samples, capacity) {
                assert!(wave.pixel_count >= 1 && wave.pixel_count <= capacity.min(WAVE_LIMIT));
                for pixel in wave.first_pixel..wave.first_pixel + wave.pixel_count {
                    seen[(wave.sample * pixels + pixel) as usize] += 1;
                }
            }
            assert!(seen.iter().all(|&count| count == 1));
        }
    }

    #[test]
    fn waves_follow_the_device() {
        let gibibyte = 1 << 30;
        assert_eq!(suitable(true, 64 * gibibyte, u64::MAX), SMALL_WAVE);
        assert_eq!(suitable(false, 80 * gibibyte, 4 * gibibyte), WAVE_LIMIT);
        assert_eq!(suitable(false, 4 * gibibyte, 4 * gibibyte), 1 << 19);
        assert_eq!(suitable(false, 80 * gibibyte, 1 << 26), 1 << 19);
        assert_eq!(suitable(false, gibibyte / 4, 1 << 27), SMALL_WAVE);
    }

    #[test]
    fn samples_are_taken_one_after_the_other() {
        let samples: Vec<u32> = waves(10, 3, 4).map(|wave| wave.sample).collect();
        assert_eq!(samples, [0, 0, 0, 1, 1, 1, 2, 2, 2]);
        let samples: Vec<u32> = waves_of(5, [1, 3], 4).map(|wave| wave.sample).collect();
        assert_eq!(samples, [1, 1, 3, 3]);
    }
}

//! Waves: the part of an image that one dispatch processes.

use std::ops::Range;

use rasray_ads::Surface;
use rasray_gpu::Device;

/// Maximum number of rays in a wave, which bounds the memory of queues and path states.
pub const WAVE_LIMIT: u32 = 1 << 20;

/// Number of rays in a wave on software drivers, whose dispatches take long, and on devices with little
/// memory.
const SMALL_WAVE: u32 = 131_072;

/// Bytes per slot of two queues and a path's state, rounded up.
const SLOT_BYTES: u64 = 512;

/// Returns the number of rays in a wave, by device: 131,072 on software drivers; on others as many as fit
/// into a sixteenth of the device's memory and into one binding, at most [`WAVE_LIMIT`]. Pictures do not
/// depend on it.
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

/// Range of pixels of which one sample is taken. Pixels are numbered row by row from the top left; slot `i`
/// of the queues holds the ray of pixel `first_pixel + i`, or of the pixel at that index of the film's list
/// ([`Film::listed`](crate::Film::listed)).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wave {
    /// Number of the first pixel in the whole image. For listed pixels it is the index in the list of the
    /// band, counted from the first pixel of the band ([`Film::write_list`](crate::Film::write_list)).
    pub first_pixel: u32,
    /// Number of pixels in the wave, at least 1, at most the capacity of the queues; all in one band
    /// ([`Bands`](crate::Bands)).
    pub pixel_count: u32,
    /// Index of the sample. Random numbers depend on it and on the pixel, never on the wave, so that the
    /// picture is independent of the division of the image.
    pub sample: u32,
}

impl Wave {
    /// Cuts one sample of these pixels, which lie in one band, into waves of at most `capacity`.
    pub fn cut(pixels: Range<u32>, sample: u32, capacity: u32) -> impl Iterator<Item = Self> {
        let capacity = capacity.clamp(1, WAVE_LIMIT);
        pixels.clone().step_by(capacity as usize).map(move |first_pixel| Self {
            first_pixel,
            pixel_count: capacity.min(pixels.end - first_pixel),
            sample,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waves_follow_the_device() {
        let gibibyte = 1 << 30;
        assert_eq!(suitable(true, 64 * gibibyte, u64::MAX), SMALL_WAVE);
        assert_eq!(suitable(false, 80 * gibibyte, 4 * gibibyte), WAVE_LIMIT);
        assert_eq!(suitable(false, 4 * gibibyte, 4 * gibibyte), 1 << 19);
        assert_eq!(suitable(false, 80 * gibibyte, 1 << 26), 1 << 19);
        assert_eq!(suitable(false, gibibyte / 4, 1 << 27), SMALL_WAVE);
    }
}

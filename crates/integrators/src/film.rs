//! Radiance summed over samples, pixel by pixel.

use rasray_gpu::{Access, Buffer, Device, Recorder};
use rasray_shaders_glsl::records::{FilmFaults, FilmPixel};

use crate::IntegratorError;
use crate::kernels::device_buffer;

/// Maximum number of pixels of an image: indices of pixels, and of their three channels, fit in 32 bits.
pub const PIXEL_LIMIT: u32 = 1 << 30;

/// The image that integrators add to. Cheap to clone; clones share the image.
///
/// Sums are f32: after n samples their relative error is about n * 2^-24 at most, less than the noise
/// of any picture up to millions of samples.
#[derive(Clone, Debug)]
pub struct Film {
    width: u32,
    height: u32,
    pixels: Buffer,
    faults: Buffer,
    list: Option<Buffer>,
}

impl Film {
    /// Allocates an image of `width` by `height` pixels. It has no samples, except on a device without a queue, where its
    /// content is undefined until [`Film::record_clear`].
    ///
    /// # Errors
    /// `ImageSize` for an image without pixels or with too many; out of memory.
    pub fn new(device: &Device, width: u32, height: u32) -> Result<Self, IntegratorError> {
        let count = pixel_count(width, height)?;
        Ok(Self {
            width,
            height,
            pixels: device_buffer(device, "film", u64::from(count) * size_of::<FilmPixel>() as u64)?,
            faults: device_buffer(device, "film faults", size_of::<FilmFaults>() as u64)?,
            list: None,
        })
    }

    /// Another image that counts its faults with those of this one.
    pub(crate) fn beside(&self, device: &Device, width: u32, height: u32) -> Result<Self, IntegratorError> {
        Ok(Self { faults: self.faults.clone(), ..Self::new(device, width, height)? })
    }

    /// The same with a list of pixels, which waves of integrators made for this film are ranges of: a sample may be taken of
    /// some pixels only ([`Film::write_list`]). All are listed, in their order. Submits and waits.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    pub fn listed(self, device: &Device) -> Result<Self, IntegratorError> {
        let bytes = u64::from(self.pixel_count()) * size_of::<u32>() as u64;
        let listed = Self { list: Some(device_buffer(device, "listed pixels", bytes)?), ..self };
        listed.write_list(device, &(0..listed.pixel_count()).collect::<Vec<_>>())?;
        Ok(listed)
    }

    /// The list of pixels, where there is one.
    pub fn list(&self) -> Option<&Buffer> {
        self.list.as_ref()
    }

    /// Says which pixels the next waves are ranges of: numbers of pixels, each at most once. Submits and waits.
    ///
    /// # Errors
    /// [`IntegratorError::NotListed`] without a list, [`IntegratorError::NoPixel`] for a number beyond the image; more pixels
    /// than the image has; the device is lost or out of memory.
    pub fn write_list(&self, device: &Device, pixels: &[u32]) -> Result<(), IntegratorError> {
        let list = self.list.as_ref().ok_or(IntegratorError::NotListed)?;
        let count = self.pixel_count();
        if let Some(&pixel) = pixels.iter().find(|pixel| **pixel >= count) {
            return Err(IntegratorError::NoPixel { pixel, count });
        }
        Ok(device.upload_slice(list, 0, pixels)?)
    }

    /// Records that all sums and faults start at 0.
    pub fn record_clear(&self, recorder: &mut Recorder<'_>) {
        self.record_clear_pixels(recorder);
        recorder.fill(&self.faults, 0, self.faults.size(), 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE | Access::TRANSFER);
    }

    /// The same of sums alone.
    pub(crate) fn record_clear_pixels(&self, recorder: &mut Recorder<'_>) {
        recorder.barrier(Access::COMPUTE | Access::TRANSFER, Access::TRANSFER_WRITE);
        recorder.fill(&self.pixels, 0, self.pixels.size(), 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE | Access::TRANSFER);
    }

    /// Pixels per row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Pixels in all.
    pub fn pixel_count(&self) -> u32 {
        self.width * self.height
    }

    /// [`FilmPixel`] per pixel, row by row from the top left.
    pub fn pixels(&self) -> &Buffer {
        &self.pixels
    }

    /// [`FilmFaults`].
    pub fn faults(&self) -> &Buffer {
        &self.faults
    }

    /// Bytes of all buffers.
    pub fn bytes(&self) -> u64 {
        self.pixels.size() + self.faults.size() + self.list.as_ref().map_or(0, Buffer::size)
    }

    /// Downloads the means of all pixels, row by row from the top left: submits and waits.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    pub fn read(&self, device: &Device) -> Result<Vec<[f32; 3]>, IntegratorError> {
        Ok(self.read_pixels(device)?.iter().map(FilmPixel::mean).collect())
    }

    /// Downloads sums and counts: submits and waits.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    pub fn read_pixels(&self, device: &Device) -> Result<Vec<FilmPixel>, IntegratorError> {
        Ok(device.download_as(&self.pixels, 0, self.pixel_count() as usize)?)
    }

    /// Downloads the count of samples that were not added: submits and waits.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    pub fn read_faults(&self, device: &Device) -> Result<FilmFaults, IntegratorError> {
        Ok(device.download_as(&self.faults, 0, 1)?.first().copied().unwrap_or_default())
    }
}

/// Pixels of an image, checked.
pub(crate) fn pixel_count(width: u32, height: u32) -> Result<u32, IntegratorError> {
    match width.checked_mul(height) {
        Some(count) if count > 0 && count <= PIXEL_LIMIT => Ok(count),
        _ => Err(IntegratorError::ImageSize { width, height, limit: PIXEL_LIMIT }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_no_samples_is_black() {
        assert_eq!(FilmPixel::default().mean(), [0.0; 3]);
        assert_eq!(FilmPixel { sum: [2.0, 4.0, 6.0], samples: 4 }.mean(), [0.5, 1.0, 1.5]);
    }

    #[test]
    fn impossible_images_are_refused() {
        assert_eq!(pixel_count(640, 360).ok(), Some(230_400));
        for (width, height) in [(0, 5), (5, 0), (65_536, 65_536), (1 << 20, 1 << 11)] {
            assert!(matches!(pixel_count(width, height), Err(IntegratorError::ImageSize { .. })));
        }
    }
}

//! Film: radiance summed over samples, pixel by pixel.

use std::ops::Range;

use rasray_gpu::{Access, Buffer, Device, Recorder};
use rasray_shaders_glsl::records::{FilmFaults, FilmPixel};

use crate::kernels::device_buffer;
use crate::{Bands, IntegratorError};

/// Image on the device that integrators add samples to. Clones are cheap and share the image.
///
/// Sums are f32: after n samples their relative error is about n * 2^-24 at most, less than the noise
/// of any picture up to millions of samples.
#[derive(Clone, Debug)]
pub struct Film {
    width: u32,
    height: u32,
    bands: Bands,
    /// Pixel records of each band.
    pixels: Vec<Buffer>,
    faults: Buffer,
    /// List of pixels of each band.
    list: Option<Vec<Buffer>>,
}

impl Film {
    /// Allocates an image of `width` by `height` pixels. It has no samples, except on a device without a
    /// queue, where its content is undefined until [`Film::record_clear`].
    ///
    /// # Errors
    /// `ImageSize` for an image without pixels or with too many; out of memory.
    pub fn new(device: &Device, width: u32, height: u32) -> Result<Self, IntegratorError> {
        Self::in_bands(device, [width, height], Bands::new(device, [width, height])?)
    }

    /// Allocates an image in bands of at most `most` pixels.
    ///
    /// # Errors
    /// Errors of [`Film::new`].
    pub fn with_bands(device: &Device, width: u32, height: u32, most: u32) -> Result<Self, IntegratorError> {
        let size = [width, height];
        Self::in_bands(device, size, Bands::new(device, size)?.at_most(most))
    }

    fn in_bands(device: &Device, [width, height]: [u32; 2], bands: Bands) -> Result<Self, IntegratorError> {
        Ok(Self {
            width,
            height,
            bands,
            pixels: band_buffers::<FilmPixel>(device, "film", bands)?,
            faults: device_buffer(device, "film faults", size_of::<FilmFaults>() as u64)?,
            list: None,
        })
    }

    /// Makes another image, in one band, that counts its faults with those of this one.
    pub(crate) fn beside(&self, device: &Device, size: [u32; 2]) -> Result<Self, IntegratorError> {
        Ok(Self { faults: self.faults.clone(), ..Self::in_bands(device, size, Bands::one(size)?)? })
    }

    /// Adds a list of pixels for each band. Waves of integrators made for this film are then ranges of the
    /// list, so that a sample may be taken of some pixels only ([`Film::write_list`]). At first the list has
    /// all pixels in their order. Submits and waits.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    pub fn listed(self, device: &Device) -> Result<Self, IntegratorError> {
        let list = Some(band_buffers::<u32>(device, "listed pixels", self.bands)?);
        let listed = Self { list, ..self };
        for (number, band) in listed.bands.ranges().enumerate() {
            listed.write_list(device, number, &band.collect::<Vec<_>>())?;
        }
        Ok(listed)
    }

    /// Returns the list of pixels of each band, if the film has lists.
    pub fn list(&self) -> Option<&[Buffer]> {
        self.list.as_deref()
    }

    /// Sets the pixels of a band of which the next samples are taken, by their numbers, each at most once.
    /// Returns the range that waves use then in place of all pixels of the band. Submits and waits.
    ///
    /// # Errors
    /// [`IntegratorError::NotListed`] without a list or such a band, [`IntegratorError::NoPixel`] for a
    /// number outside of the band; an error for more pixels than the band has, or if the device is lost or
    /// out of memory.
    pub fn write_list(
        &self,
        device: &Device,
        number: usize,
        pixels: &[u32],
    ) -> Result<Range<u32>, IntegratorError> {
        let list = self.list.as_ref().and_then(|lists| lists.get(number));
        let (Some(list), Some(band)) = (list, self.bands.ranges().nth(number)) else {
            return Err(IntegratorError::NotListed);
        };
        if let Some(&pixel) = pixels.iter().find(|pixel| !band.contains(pixel)) {
            return Err(IntegratorError::NoPixel { pixel, band });
        }
        device.upload_slice(list, 0, pixels)?;
        Ok(band.start..band.start + pixels.len() as u32)
    }

    /// Records that all sums and faults start at 0.
    pub fn record_clear(&self, recorder: &mut Recorder<'_>) {
        self.record_clear_pixels(recorder);
        recorder.fill(&self.faults, 0, self.faults.size(), 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE | Access::TRANSFER);
    }

    /// Records that all sums start at 0.
    pub(crate) fn record_clear_pixels(&self, recorder: &mut Recorder<'_>) {
        recorder.barrier(Access::COMPUTE | Access::TRANSFER, Access::TRANSFER_WRITE);
        for pixels in &self.pixels {
            recorder.fill(pixels, 0, pixels.size(), 0);
        }
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE | Access::TRANSFER);
    }

    /// Returns the division of the film's pixels among buffers.
    pub fn bands(&self) -> Bands {
        self.bands
    }

    /// Returns the number of pixels per row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Returns the number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Returns the number of pixels in all.
    pub fn pixel_count(&self) -> u32 {
        self.bands.pixel_count()
    }

    /// Returns the buffer of each band: [`FilmPixel`] per pixel, row by row from the top left.
    pub fn pixels(&self) -> &[Buffer] {
        &self.pixels
    }

    /// Returns the buffer of [`FilmFaults`].
    pub fn faults(&self) -> &Buffer {
        &self.faults
    }

    /// Returns the bytes of the records of all pixels.
    pub(crate) fn pixel_bytes(&self) -> u64 {
        self.pixels.iter().map(Buffer::size).sum()
    }

    /// Returns the bytes of all buffers.
    pub fn bytes(&self) -> u64 {
        let list = self.list.iter().flatten().map(Buffer::size).sum::<u64>();
        self.pixel_bytes() + self.faults.size() + list
    }

    /// Downloads the means of all pixels, row by row from the top left: submits and waits.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    pub fn read(&self, device: &Device) -> Result<Vec<[f32; 3]>, IntegratorError> {
        let mut means = Vec::with_capacity(self.pixel_count() as usize);
        self.read_bands(device, |pixels| means.extend(pixels.iter().map(FilmPixel::mean)))?;
        Ok(means)
    }

    /// Downloads sums and counts: submits and waits.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    pub fn read_pixels(&self, device: &Device) -> Result<Vec<FilmPixel>, IntegratorError> {
        let mut all = Vec::with_capacity(self.pixel_count() as usize);
        self.read_bands(device, |pixels| all.extend_from_slice(pixels))?;
        Ok(all)
    }

    /// Passes sums and counts to `take` band by band, so that no copy of all is needed: submits and waits.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    pub fn read_bands(
        &self,
        device: &Device,
        mut take: impl FnMut(&[FilmPixel]),
    ) -> Result<(), IntegratorError> {
        for (pixels, band) in self.pixels.iter().zip(self.bands.ranges()) {
            take(&device.download_as(pixels, 0, band.len())?);
        }
        Ok(())
    }

    /// Downloads the count of samples that were not added: submits and waits.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    pub fn read_faults(&self, device: &Device) -> Result<FilmFaults, IntegratorError> {
        Ok(device.download_as(&self.faults, 0, 1)?.first().copied().unwrap_or_default())
    }
}

/// Makes a buffer per band with a record per pixel.
fn band_buffers<T>(device: &Device, name: &str, bands: Bands) -> Result<Vec<Buffer>, IntegratorError> {
    bands.ranges().map(|band| device_buffer(device, name, (band.len() * size_of::<T>()) as u64)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_no_samples_is_black() {
        assert_eq!(FilmPixel::default().mean(), [0.0; 3]);
        assert_eq!(FilmPixel { sum: [2.0, 4.0, 6.0], samples: 4 }.mean(), [0.5, 1.0, 1.5]);
    }
}

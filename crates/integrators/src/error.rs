//! Errors of integrators.

use std::ops::Range;

use rasray_options::ValueError;

use crate::{WAVE_LIMIT, Wave};

/// Errors of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum IntegratorError {
    /// A wave has no pixels, or more than the queues have slots.
    #[error("the wave at pixel {} has {} pixels; from 1 to {capacity} are possible: cut it smaller", wave.first_pixel, wave.pixel_count)]
    WaveSize {
        /// The requested wave.
        wave: Wave,
        /// Number of slots of the queues.
        capacity: u32,
    },
    /// A wave reaches past the last pixel.
    #[error("the wave of {} pixels at pixel {} leaves the image of {pixels} pixels", wave.pixel_count, wave.first_pixel)]
    WaveOutsideImage {
        /// The requested wave.
        wave: Wave,
        /// Number of pixels of the image.
        pixels: u32,
    },
    /// The records of a wave's pixels are in different buffers.
    #[error("the wave of {} pixels at pixel {} is of two bands: cut it at multiples of {most} pixels (`Bands::waves`)", wave.pixel_count, wave.first_pixel)]
    WaveOfTwoBands {
        /// The requested wave.
        wave: Wave,
        /// Number of pixels of a band.
        most: u32,
    },
    /// The image has no pixels, or more than can be numbered.
    #[error(
        "an image of {width} x {height} pixels cannot be rendered; choose from 1 to {limit} pixels in all"
    )]
    ImageSize {
        /// Pixels per row.
        width: u32,
        /// Number of rows.
        height: u32,
        /// Largest number of pixels.
        limit: u32,
    },
    /// Film and scene have different image sizes.
    #[error("the film has {film:?} pixels, but the scene's view has {view:?}: make both from the same size")]
    SizesDiffer {
        /// Width and height of the film.
        film: [u32; 2],
        /// Width and height of the scene's view.
        view: [u32; 2],
    },
    /// A listed pixel is outside of the band.
    #[error("pixel {pixel} was listed, of a band from pixel {} to {}", band.start, band.end - 1)]
    NoPixel {
        /// Number of the pixel.
        pixel: u32,
        /// Numbers of the band's pixels.
        band: Range<u32>,
    },
    /// Some pixels of a film were requested, but the film has no list of pixels for such a band.
    #[error("the film has no list of pixels of this band: make it with `Film::listed`")]
    NotListed,
    /// Kernels look surfaces up by hits, and the traced structure does not allow it.
    #[error("surfaces of {structure} are not those of triangles alone: leave out `surfaces_of_hits`")]
    SurfacesOfHits {
        /// Name of the structure.
        structure: &'static str,
    },
    /// Waves have no rays, or more than the maximum.
    #[error("a wave of up to {capacity} rays cannot be made: from 1 to {WAVE_LIMIT} are possible")]
    WaveCapacity {
        /// Requested number of slots.
        capacity: u32,
    },
    /// The integrator has no such option.
    #[error("integrator {integrator} has no option `{option}`")]
    UnknownOption {
        /// Name of the integrator.
        integrator: &'static str,
        /// Name of the option.
        option: &'static str,
    },
    /// The option of the integrator has no such value.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// A new scene for existing kernels needs code that they leave out.
    #[error(
        "kernels were made without code for {missing}: make them for a scene that allows it (`GpuScene::allowing`)"
    )]
    LeftOut {
        /// Features of the scene that the kernels lack.
        missing: String,
    },
    /// The photons of a sample exceed one binding.
    #[error(
        "photons of a sample may take {bytes} bytes, and the device binds {limit}: emit fewer, or let them scatter less often"
    )]
    PhotonBytes {
        /// Bytes of all photons that may be stored.
        bytes: u64,
        /// Largest number of bytes of a binding.
        limit: u64,
    },
    /// Some surfaces have too many photons around them.
    #[error(
        "{surfaces} surfaces have more than {limit} photons around them: choose a smaller radius, or emit fewer photons"
    )]
    Crowded {
        /// Number of such surfaces, over all samples.
        surfaces: u32,
        /// Largest number of photons of a surface.
        limit: u32,
    },
    /// The device cannot draw the first hits of camera rays.
    #[error("what the camera sees cannot be drawn: {reason}")]
    CannotDraw {
        /// Feature or limit that the device lacks.
        reason: String,
    },
    /// The device cannot fetch surfaces by drawing.
    #[error("surfaces cannot be fetched by drawing: {reason}")]
    CannotFetch {
        /// Feature or limit that the device lacks.
        reason: String,
    },
    /// A call of the Vulkan layer failed.
    #[error(transparent)]
    Gpu(#[from] rasray_gpu::GpuError),
    /// A structure or a queue failed.
    #[error(transparent)]
    Ads(#[from] rasray_ads::AdsError),
}

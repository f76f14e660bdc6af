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
        /// The wave asked for.
        wave: Wave,
        /// Slots in the queues.
        capacity: u32,
    },
    /// A wave reaches past the last pixel.
    #[error("the wave of {} pixels at pixel {} leaves the image of {pixels} pixels", wave.pixel_count, wave.first_pixel)]
    WaveOutsideImage {
        /// The wave asked for.
        wave: Wave,
        /// Pixels of the image.
        pixels: u32,
    },
    /// A wave has pixels whose records are in different buffers.
    #[error("the wave of {} pixels at pixel {} is of two bands: cut it at multiples of {most} pixels (`Bands::waves`)", wave.pixel_count, wave.first_pixel)]
    WaveOfTwoBands {
        /// The wave asked for.
        wave: Wave,
        /// Pixels of a band.
        most: u32,
    },
    /// An image without pixels, or with more than can be numbered.
    #[error(
        "an image of {width} x {height} pixels cannot be rendered; choose from 1 to {limit} pixels in all"
    )]
    ImageSize {
        /// Pixels per row.
        width: u32,
        /// Rows.
        height: u32,
        /// Largest product.
        limit: u32,
    },
    /// Film and scene disagree about the image.
    #[error("the film has {film:?} pixels, but the scene's view has {view:?}: make both from the same size")]
    SizesDiffer {
        /// Width and height of the film.
        film: [u32; 2],
        /// Width and height of the scene's view.
        view: [u32; 2],
    },
    /// A pixel was listed that the band does not have.
    #[error("pixel {pixel} was listed, of a band from pixel {} to {}", band.start, band.end - 1)]
    NoPixel {
        /// Its number.
        pixel: u32,
        /// Pixels of the band.
        band: Range<u32>,
    },
    /// Some pixels of a film were asked for that has no list of the pixels of such a band.
    #[error("the film has no list of pixels of this band: make it with `Film::listed`")]
    NotListed,
    /// Kernels look surfaces up by hits, and what is traced does not allow that.
    #[error("surfaces of {structure} are not those of triangles alone: leave out `surfaces_of_hits`")]
    SurfacesOfHits {
        /// The structure that is traced.
        structure: &'static str,
    },
    /// Waves without rays, or with more than there can be.
    #[error("a wave of up to {capacity} rays cannot be made: from 1 to {WAVE_LIMIT} are possible")]
    WaveCapacity {
        /// Slots asked for.
        capacity: u32,
    },
    /// An integrator has no such option.
    #[error("integrator {integrator} has no option `{option}`")]
    UnknownOption {
        /// The integrator.
        integrator: &'static str,
        /// The option.
        option: &'static str,
    },
    /// An option of an integrator has no such value.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// A scene that is to take the place of the one that kernels were made for can reach code that they leave
    /// out.
    #[error(
        "kernels were made without code for {missing}: make them for a scene that allows it (`GpuScene::allowing`)"
    )]
    LeftOut {
        /// Features of the scene that the kernels lack.
        missing: String,
    },
    /// Photons of a sample do not fit into what one binding holds.
    #[error(
        "photons of a sample may take {bytes} bytes, and the device binds {limit}: emit fewer, or let them scatter less often"
    )]
    PhotonBytes {
        /// Bytes of all that may be stored.
        bytes: u64,
        /// Most bytes of a binding.
        limit: u64,
    },
    /// Surfaces have too many photons around them.
    #[error(
        "{surfaces} surfaces have more than {limit} photons around them: choose a smaller radius, or emit fewer photons"
    )]
    Crowded {
        /// Surfaces, of all samples.
        surfaces: u32,
        /// Most photons of a surface.
        limit: u32,
    },
    /// First hits of camera rays cannot be found by drawing.
    #[error("what the camera sees cannot be drawn: {reason}")]
    CannotDraw {
        /// Feature or limit that the device lacks.
        reason: String,
    },
    /// Surfaces cannot be fetched by drawing.
    #[error("surfaces cannot be fetched by drawing: {reason}")]
    CannotFetch {
        /// Feature or limit that the device lacks.
        reason: String,
    },
    /// The Vulkan layer failed.
    #[error(transparent)]
    Gpu(#[from] rasray_gpu::GpuError),
    /// A structure or a queue failed.
    #[error(transparent)]
    Ads(#[from] rasray_ads::AdsError),
}

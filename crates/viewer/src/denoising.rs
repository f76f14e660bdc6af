//! Denoising of the picture, from time to time while it refines.

use std::time::{Duration, Instant};

use rasray_denoise::{DenoiseError, Denoiser, NoisyPicture};
use rasray_experiment::{Built, DeviceScene, ExperimentError, ProgressiveImage};

/// Pause between two denoisings, in multiples of the last one's duration: a fifth of the time is spent on
/// denoising.
const PAUSE: u32 = 4;

/// Denoiser of pictures, with the auxiliary images of the picture that refines.
pub(crate) struct Denoising {
    denoiser: Denoiser,
    /// Albedo and normal of the picture, once they were asked for.
    fed: Option<[Vec<[f32; 3]>; 2]>,
    /// Time of the next denoising while the picture refines; absent for at once.
    due: Option<Instant>,
}

impl Denoising {
    /// Makes a denoiser with the library of this machine.
    pub(crate) fn find() -> Result<Self, DenoiseError> {
        Ok(Self { denoiser: Denoiser::find()?, fed: None, due: None })
    }

    /// Begins another picture, to which all following samples belong.
    pub(crate) fn begin(&mut self) {
        (self.fed, self.due) = (None, None);
    }

    /// Returns name and version of the library.
    pub(crate) fn version(&self) -> &str {
        self.denoiser.version()
    }

    /// True if the next denoising is due while the picture refines.
    pub(crate) fn is_due(&self) -> bool {
        self.due.is_none_or(|due| Instant::now() >= due)
    }

    /// True if the denoiser has albedo and normal of the picture.
    pub(crate) fn is_fed(&self) -> bool {
        self.fed.is_some()
    }

    /// Makes albedo and normal of the rendered scene for the denoiser.
    pub(crate) fn feed(
        &mut self,
        rendering: &ProgressiveImage,
        stage: &DeviceScene,
        built: &Built,
    ) -> Result<(), ExperimentError> {
        self.fed = Some(rendering.for_denoising(stage, built)?);
        Ok(())
    }

    /// Returns the picture of this size without noise; [`Denoising::feed`] was called before.
    pub(crate) fn denoised(
        &mut self,
        size: [u32; 2],
        colour: &[[f32; 3]],
    ) -> Result<Vec<[f32; 3]>, DenoiseError> {
        let started = Instant::now();
        let [albedo, normal] =
            self.fed.as_ref().map_or([&[][..]; 2], |fed| fed.each_ref().map(Vec::as_slice));
        let picture = NoisyPicture { size: size.map(|side| side as usize), colour, albedo, normal };
        let denoised = self.denoiser.denoise(&picture)?;
        let took: Duration = started.elapsed();
        self.due = Some(Instant::now() + PAUSE * took);
        Ok(denoised)
    }
}

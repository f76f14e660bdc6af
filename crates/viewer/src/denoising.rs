//! The picture without noise, now and then while it refines.

use std::time::{Duration, Instant};

use rasray_denoise::{DenoiseError, Denoiser, NoisyPicture};
use rasray_experiment::{Built, DeviceScene, ExperimentError, ProgressiveImage};

/// From the end of one to the begin of the next, in times of what the last one took: a fifth of the time is
/// spent on it.
const PAUSE: u32 = 4;

/// Denoiser of pictures, with what it knows of the one that refines.
pub(crate) struct Denoising {
    denoiser: Denoiser,
    /// Albedo and normal of the picture, once they were asked for.
    fed: Option<[Vec<[f32; 3]>; 2]>,
    /// When the picture is denoised next while it refines; absent: at once.
    due: Option<Instant>,
}

impl Denoising {
    /// With the library of this machine.
    pub(crate) fn find() -> Result<Self, DenoiseError> {
        Ok(Self { denoiser: Denoiser::find()?, fed: None, due: None })
    }

    /// The samples are of another picture from now on.
    pub(crate) fn begin(&mut self) {
        (self.fed, self.due) = (None, None);
    }

    /// Name and version of the library.
    pub(crate) fn version(&self) -> &str {
        self.denoiser.version()
    }

    /// True if it is time for it while the picture refines.
    pub(crate) fn is_due(&self) -> bool {
        self.due.is_none_or(|due| Instant::now() >= due)
    }

    /// True if it knows albedo and normal of the picture.
    pub(crate) fn is_fed(&self) -> bool {
        self.fed.is_some()
    }

    /// Feeds it with those of what is rendered.
    pub(crate) fn feed(
        &mut self,
        rendering: &ProgressiveImage,
        stage: &DeviceScene,
        built: &Built,
    ) -> Result<(), ExperimentError> {
        self.fed = Some(rendering.for_denoising(stage, built)?);
        Ok(())
    }

    /// The picture of this size without noise; it was fed.
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

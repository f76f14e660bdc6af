//! Image of a job, rendered wave by wave.

use std::ops::ControlFlow;

use rasray_frame::{Advance, ImagePasses, ImageRenderer};
use rasray_gpu::Device;
use rasray_integrators::{Film, FilmFaults, IntegratorDesc, PATH_LAYER_LIMIT, Visibility};
use rasray_scene::needs::Needs;

use crate::backend::{OnProgress, Progress};
use crate::built::Built;
use crate::device_scene::DeviceScene;
use crate::error::{ExperimentError, OccluderError};
use crate::jobs::{Frame, OccluderKind, Primary};
use crate::passes::Passes;
use crate::shard::Shard;
use rasray_report::{Memory, Pass, PassOf};

/// Returns the source of first hits of a frame that replaces traces; `None` if first hits are traced.
fn visibility(
    device: &Device,
    stage: &DeviceScene,
    frame: &Frame,
) -> Result<Option<Visibility>, ExperimentError> {
    match frame.primary {
        Primary::Trace => Ok(None),
        Primary::Raster | Primary::Fragments if stage.scene.frame().lens_radius > 0.0 => {
            Err(ExperimentError::Pinhole { primary: frame.primary.name() })
        }
        Primary::Fragments => Ok(None),
        Primary::Raster => Ok(Some(Visibility::new(device, &stage.scene, false)?)),
    }
}

/// Replaces traces of shadow rays by the passes of the frame's occluder.
fn with_occluder(
    passes: ImagePasses,
    device: &Device,
    stage: &DeviceScene,
    frame: &Frame,
) -> Result<ImagePasses, ExperimentError> {
    let OccluderKind::ShadowMaps { resolution, points } = frame.occluder else { return Ok(passes) };
    if !passes.integrator().asks_occluder() {
        let features = stage.scene.features();
        return Err(match frame.workload().scatters {
            true if features.blend => OccluderError::Blended,
            true if features.panes => OccluderError::Panes {
                can_be_opaque: frame.integrator.row().option("glass-shadows").is_some(),
            },
            _ => OccluderError::NoShadowRays { integrator: frame.integrator.name() },
        }
        .into());
    }
    if frame.back_faces.lets_other_rays() {
        return Err(OccluderError::BackFaces.into());
    }
    let (has_lights, has_emitters) = (!stage.scene.lights().is_empty(), stage.scene.emitter_count() > 0);
    if points > 0 && !has_emitters {
        tracing::warn!("nothing in the scene emits: no triangle has maps (shadow-points)");
    }
    if !has_lights && (points == 0 || !has_emitters) {
        tracing::warn!(
            "the scene has no point, spot or directional light: every shadow ray is traced (shadow-maps)"
        );
    }
    let config = rasray_shadow_maps::Config { points, ..rasray_shadow_maps::Config::new(resolution) };
    passes
        .with_shadow_maps(device, &stage.scene, config)
        .map_err(|source| ExperimentError::ShadowMaps { points, source })
}

/// Image of a job in progress, with the times of its passes. Every call submits and waits.
pub struct ProgressiveImage {
    /// Image on the film.
    pub(super) image: ImageRenderer,
    pub(super) passes: Passes,
    /// True if the kernels look up the surfaces of hits.
    of_hits: bool,
}

impl ProgressiveImage {
    /// Allocates the film of a frame and makes its integrator; nothing is rendered. The scene's view has the
    /// size of the frame. With a shard, only the samples of the shard are made. `built` is the structure that
    /// will be traced, or one with hits of the same kind ([`ProgressiveImage::serves`]).
    ///
    /// # Errors
    /// The device fails, or the frame asks for more than the integrator can do, or for first hits that
    /// `built` does not have.
    pub fn new(
        device: &Device,
        (stage, built): (&DeviceScene, &Built),
        frame: &Frame,
        shard: Option<Shard>,
        needs: &Needs,
    ) -> Result<Self, ExperimentError> {
        Self::check(frame, built)?;
        let film = Film::new(device, frame.width, frame.height);
        let film = match frame.adaptive {
            Some(_) => film.and_then(|film| film.listed(device)),
            None => film,
        };
        let film = film?;
        let mut desc = IntegratorDesc::new(device, &stage.scene, &film);
        if *needs == Needs::all() {
            desc.features = rasray_gpu_scene::ShadingFeatures::ALL;
        }
        desc.surfaces_of_hits = built.structure().description().surfaces_of_triangles;
        let passes = ImagePasses::from(frame.integrator.make(&desc)?);
        let passes = passes.with_visibility(visibility(device, stage, frame)?);
        let passes = if frame.primary == Primary::Fragments { passes.with_stored_hits() } else { passes };
        let passes = with_occluder(passes, device, stage, frame)?;
        let samples = shard.unwrap_or_default().samples(frame.spp);
        let image = ImageRenderer::new(device, passes, samples);
        let image = match frame.adaptive {
            Some(rule) => image.and_then(|image| image.adapting(rule)),
            None => image,
        };
        Ok(Self { image: image?, passes: Passes::default(), of_hits: desc.surfaces_of_hits })
    }

    /// True if the image can be rendered through `built` with the kernels that it has.
    pub fn serves(&self, built: &Built) -> bool {
        !self.of_hits || built.structure().description().surfaces_of_triangles
    }

    /// Turns on the measurement of each pixel's variance.
    #[must_use]
    pub(super) fn measuring(self) -> Self {
        Self { image: self.image.measuring(), ..self }
    }

    /// Refuses a structure that lacks the first hits which the frame takes from it.
    ///
    /// # Errors
    /// The structure has no first hits.
    pub(super) fn check(frame: &Frame, built: &Built) -> Result<(), ExperimentError> {
        let structure = built.structure().description();
        if frame.primary != Primary::Fragments || structure.first_hits {
            return Ok(());
        }
        Err(ExperimentError::NoFirstHits { structure: structure.name })
    }

    /// Returns the image on the film.
    pub fn image(&self) -> &ImageRenderer {
        &self.image
    }

    /// Adds the bytes of the buffers of the image.
    pub(super) fn write_memory(&self, memory: &mut Memory) {
        let passes = self.image.passes();
        let bytes: u64 = passes.bytes_by_part().iter().map(|(_, bytes)| bytes).sum();
        memory.frame_bytes = Some(bytes);
        memory.frame_bytes_per_pixel = Some(bytes as f64 / f64::from(passes.film().pixel_count()));
    }

    /// Adds the bytes of the buffers of the image part by part, and of shadow maps.
    pub(super) fn write_memory_by_part(&self, memory: &mut Memory) {
        let passes = self.image.passes();
        let parts = passes.bytes_by_part().into_iter();
        memory.by_part.extend(parts.map(|(name, bytes)| (format!("image {name}"), bytes)));
        if let Some(maps) = passes.shadow_maps() {
            memory.by_part.insert("shadow maps".to_owned(), maps.bytes());
        }
    }

    /// Resets film, counters and times to 0.
    ///
    /// # Errors
    /// The device fails.
    pub fn clear(&mut self) -> Result<(), ExperimentError> {
        self.passes = Passes::default();
        Ok(self.image.clear()?)
    }

    /// Takes note of a moved scene, see [`ImageRenderer::scene_moved`].
    pub fn scene_moved(&mut self) {
        self.image.scene_moved();
    }

    /// Warms up the kernels, see [`ImageRenderer::warm_up`].
    ///
    /// # Errors
    /// The device fails.
    pub fn warm_up(&mut self, built: &Built) -> Result<f64, ExperimentError> {
        Ok(self.image.warm_up(built.structure())?)
    }

    /// Renders the next wave. Returns false if rays needed more rounds than they had: the image then starts
    /// over, and the structure allows more rounds from then on.
    ///
    /// # Errors
    /// The device fails, or rays met list entries that refer to nothing.
    pub fn advance(&mut self, device: &Device, built: &Built) -> Result<bool, ExperimentError> {
        let step = self.image.advance(built.structure(), device.best_timing())?;
        Ok(keep_times(&mut self.passes, &step))
    }

    /// Renders all samples, or the samples up to an early end that `progress` asks for.
    ///
    /// # Errors
    /// As for [`ProgressiveImage::advance`].
    pub(super) fn render(
        &mut self,
        device: &Device,
        built: &Built,
        task: &str,
        progress: &mut OnProgress<'_>,
    ) -> Result<(), ExperimentError> {
        let Self { image, passes, .. } = self;
        let after = |image: &ImageRenderer, step: Advance| {
            if !keep_times(passes, &step) {
                return ControlFlow::Continue(());
            }
            let (done, total) = (image.waves_done(), image.waves());
            progress(Progress { task, done, total, unit: "waves" })
        };
        Ok(image.render(built.structure(), device.best_timing(), after)?)
    }

    /// Warns of faults of the picture: samples that are not numbers, and light behind too many surfaces.
    ///
    /// # Errors
    /// The device fails.
    pub fn warn_of_faults(&self, device: &Device) -> Result<FilmFaults, ExperimentError> {
        let faults = self.image.film().read_faults(device)?;
        if faults.non_finite > 0 {
            tracing::warn!("{} samples were not finite numbers and are left out", faults.non_finite);
        }
        if faults.cut > 0 {
            tracing::warn!(
                "{} rays would have passed more than {PATH_LAYER_LIMIT} transparent surfaces: what lies behind those is left out",
                faults.cut
            );
        }
        Ok(faults)
    }

    /// Logs how many triangles were drawn over all pixels, if camera rays are drawn.
    pub(super) fn log_visibility(&self, device: &Device) -> Result<(), ExperimentError> {
        if let Some(visibility) = self.image.passes().visibility() {
            let covering = visibility.read_counts(device)?.covering;
            tracing::info!(
                covering,
                "triangles drawn over all pixels, of all waves: they reach behind the eye"
            );
        }
        Ok(())
    }

    /// Reads the means of all pixels, row by row from the top left; linear Rec. 709, W/(sr m^2).
    ///
    /// # Errors
    /// The device fails.
    pub fn read(&self, device: &Device) -> Result<Vec<[f32; 3]>, ExperimentError> {
        Ok(self.image.film().read(device)?)
    }

    /// Returns the times of the passes since the film was cleared, all waves together.
    pub fn pass_times(&self) -> Vec<Pass> {
        self.passes.report(Some(PassOf::Image))
    }
}

/// Adds the times of a wave. Drops all times and returns false if the image starts over.
fn keep_times(passes: &mut Passes, step: &Advance) -> bool {
    match step {
        Advance::Wave { passes: timings } => passes.add(timings),
        Advance::StartedOver => *passes = Passes::default(),
    }
    matches!(step, Advance::Wave { .. })
}

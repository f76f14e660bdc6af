//! Passes of an image.

use rasray_ads::{Occluder, QueueCounters, Structure};
use rasray_gpu::{Device, Recorder};
use rasray_gpu_scene::{GpuScene, PosedBuffers};
use rasray_integrators::{Film, FirstHits, Integrator, Traced, Visibility, Wave};
use rasray_shadow_maps::{Config, Emitters, Lights, ShadowMaps};
use rasray_tracer::TracerError;

use crate::{FrameError, Samples};

/// Records the passes of an image of rays through a structure: an integrator with its film, and what answers
/// camera and shadow rays. It records, and neither submits nor waits.
pub struct ImagePasses {
    integrator: Box<dyn Integrator>,
    /// Answers camera rays in place of traces.
    visibility: Option<Visibility>,
    /// True if the structure's view of the camera answers camera rays.
    has_stored_hits: bool,
    /// Answers shadow rays in place of traces.
    shadow_maps: Option<ShadowMaps>,
    /// True if the maps are to be drawn before they are asked.
    maps_are_stale: bool,
}

impl From<Box<dyn Integrator>> for ImagePasses {
    fn from(integrator: Box<dyn Integrator>) -> Self {
        Self { integrator, visibility: None, has_stored_hits: false, shadow_maps: None, maps_are_stale: true }
    }
}

impl<I: Integrator + 'static> From<Box<I>> for ImagePasses {
    fn from(integrator: Box<I>) -> Self {
        Self::from(integrator as Box<dyn Integrator>)
    }
}

/// The lights of a scene that may have shadow maps.
fn lights(scene: &GpuScene) -> Lights<'_> {
    let PosedBuffers { lights, emissive, .. } = scene.posed_buffers();
    let emitters = Some(Emitters { records: emissive, count: scene.emitter_count() });
    Lights { records: lights, known: scene.lights(), emitters }
}

impl ImagePasses {
    /// Answers camera rays by drawing, which was made for the same scene; by traces where absent.
    #[must_use]
    pub fn with_visibility(self, visibility: Option<Visibility>) -> Self {
        Self { visibility, ..self }
    }

    /// Answers camera rays by the structure's view of the camera, which must have one
    /// ([`Description::first_hits`](rasray_ads::Description::first_hits)); not together with drawing.
    #[must_use]
    pub fn with_stored_hits(self) -> Self {
        Self { has_stored_hits: true, visibility: None, ..self }
    }

    /// Answers shadow rays that lead to lights without extent by shadow maps of the scene, and where
    /// [`Config::points`] asks for it those that lead to emitting triangles.
    ///
    /// # Errors
    /// As [`ShadowMaps::new`].
    pub fn with_shadow_maps(
        self,
        device: &Device,
        scene: &GpuScene,
        config: Config,
    ) -> Result<Self, FrameError> {
        let (geometry, binding) = (scene.geometry(), scene.binding());
        let maps = ShadowMaps::new(device, config, geometry, Some(binding), lights(scene))?;
        Ok(Self { shadow_maps: Some(maps), ..self })
    }

    /// Shadow maps, which answer shadow rays in place of traces.
    pub fn shadow_maps(&self) -> Option<&ShadowMaps> {
        self.shadow_maps.as_ref()
    }

    /// Lights or triangles have moved, or will have by the time that the next image is recorded.
    pub fn scene_moved(&mut self) {
        self.maps_are_stale = true;
    }

    /// True if [`ImagePasses::record_shadow_maps`] would record anything.
    pub(crate) fn needs_shadow_maps(&self) -> bool {
        self.maps_are_stale && self.shadow_maps.is_some()
    }

    /// Records that shadow maps are drawn, where anything has moved since they were recorded. True where they
    /// are.
    pub(crate) fn record_shadow_maps(&mut self, recorder: &mut Recorder<'_>) -> bool {
        let are_stale = std::mem::take(&mut self.maps_are_stale);
        let Some(maps) = self.shadow_maps.as_ref().filter(|_| are_stale) else { return false };
        maps.record_build(recorder);
        true
    }

    /// The integrator, with the film.
    pub fn integrator(&self) -> &dyn Integrator {
        self.integrator.as_ref()
    }

    /// Drawing that answers camera rays in place of traces.
    pub fn visibility(&self) -> Option<&Visibility> {
        self.visibility.as_ref()
    }

    /// Film that samples are added to.
    pub fn film(&self) -> &Film {
        self.integrator.film()
    }

    /// Names and bytes of the buffers of an image: the film, queues part by part, what the integrator keeps
    /// per slot, what fetches surfaces by drawing, and what draws first hits. Shadow maps are apart.
    pub fn bytes_by_part(&self) -> Vec<(&'static str, u64)> {
        let integrator = self.integrator();
        let mut parts = vec![("film", integrator.film().bytes())];
        for (name, bytes) in integrator.queues().iter().flat_map(|queue| queue.bytes_by_part()) {
            match parts.iter_mut().find(|(known, _)| *known == name) {
                Some((_, sum)) => *sum += bytes,
                None => parts.push((name, bytes)),
            }
        }
        parts.push(("integrator states", integrator.state_bytes()));
        parts.push(("fetch", integrator.fetch_bytes()));
        parts.push(("first hits", self.visibility.as_ref().map_or(0, Visibility::bytes)));
        parts.retain(|(_, bytes)| *bytes > 0);
        parts
    }

    /// Shows another scene from the next recording on, in a film of the same size. Kernels stay; shadow maps
    /// grow where there are more lights.
    ///
    /// # Errors
    /// The scene has what kernels have no code for, or out of memory.
    pub fn set_scene(&mut self, device: &Device, scene: &GpuScene) -> Result<(), FrameError> {
        self.integrator.set_scene(scene)?;
        if let Some(visibility) = &mut self.visibility {
            visibility.set_scene(scene)?;
        }
        if let Some(maps) = &mut self.shadow_maps {
            maps.set_scene(scene.binding())?;
            maps.set_lights(device, lights(scene))?;
            maps.set_geometry(scene.geometry());
        }
        self.maps_are_stale = true;
        Ok(())
    }

    /// Rays through a structure, but for those that are drawn or answered by maps.
    pub(crate) fn traced<'a>(&'a self, structure: &'a dyn Structure) -> Traced<'a> {
        let maps = self.shadow_maps.as_ref().map(|maps| maps as &dyn Occluder);
        let primary = match self.has_stored_hits {
            true => FirstHits::Stored,
            false => self.visibility.as_ref().into(),
        };
        Traced::from(structure).with_primary(primary).with_occluder(maps)
    }

    /// Records that film and counters start at 0.
    pub fn record_reset(&self, recorder: &mut Recorder<'_>) {
        self.integrator.record_reset(recorder);
        if let Some(visibility) = &self.visibility {
            visibility.record_reset(recorder);
        }
    }

    /// The waves of samples, in their order.
    pub fn waves(&self, samples: Samples) -> impl Iterator<Item = Wave> {
        self.film().bands().waves(samples, self.integrator.wave_capacity())
    }

    /// Records samples of all pixels.
    ///
    /// # Errors
    /// The structure was made without a scene.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        structure: &dyn Structure,
        samples: Samples,
    ) -> Result<(), FrameError> {
        for wave in self.waves(samples) {
            self.integrator.record_wave(recorder, self.traced(structure), wave)?;
        }
        Ok(())
    }
}

impl std::fmt::Debug for ImagePasses {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("ImagePasses")
            .field("integrator", &self.integrator.name())
            .field("visibility", &self.visibility)
            .field("shadow_maps", &self.shadow_maps)
            .finish()
    }
}

/// Rays of queues that have no answer, those that met an unbuilt structure included: where there are any,
/// nothing that was made of them is right.
///
/// # Errors
/// Rays met list entries with an invalid index.
pub(crate) fn unanswered<'a>(
    structure: &dyn Structure,
    counters: impl IntoIterator<Item = &'a QueueCounters>,
) -> Result<u64, FrameError> {
    let (mut rays, mut entries) = (0, 0);
    for queue in counters {
        entries += u64::from(queue.corrupted);
        rays += u64::from(queue.unfinished) + u64::from(queue.not_ready);
    }
    if entries > 0 {
        return Err(TracerError::Corrupted { structure: structure.description().name, entries }.into());
    }
    Ok(rays)
}

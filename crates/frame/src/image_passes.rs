//! Passes that render an image.

use rasray_ads::{Occluder, QueueCounters, Structure};
use rasray_gpu::{Device, Recorder};
use rasray_gpu_scene::{GpuScene, PosedBuffers};
use rasray_integrators::{Film, FirstHits, Integrator, Traced, Visibility, Wave};
use rasray_shadow_maps::{Config, Emitters, Lights, ShadowMaps};
use rasray_tracer::TracerError;

use crate::{FrameError, Samples};

/// Records the passes that render an image through a structure: those of an integrator with its film, and the
/// passes that answer camera rays and shadow rays. It neither submits nor waits.
pub struct ImagePasses {
    integrator: Box<dyn Integrator>,
    /// Drawing that answers camera rays in place of traces.
    visibility: Option<Visibility>,
    /// True if the structure's view of the camera answers camera rays.
    has_stored_hits: bool,
    /// Shadow maps that answer shadow rays in place of traces.
    shadow_maps: Option<ShadowMaps>,
    /// True if the shadow maps must be drawn before they are used.
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

/// Returns the lights of a scene that may have shadow maps.
fn lights(scene: &GpuScene) -> Lights<'_> {
    let PosedBuffers { lights, emissive, .. } = scene.posed_buffers();
    let emitters = Some(Emitters { records: emissive, count: scene.emitter_count() });
    Lights { records: lights, known: scene.lights(), emitters }
}

impl ImagePasses {
    /// Answers camera rays by drawing, with a [`Visibility`] that was made for the same scene; if absent, by
    /// traces.
    #[must_use]
    pub fn with_visibility(self, visibility: Option<Visibility>) -> Self {
        Self { visibility, ..self }
    }

    /// Answers camera rays by the structure's view of the camera, which the structure must have
    /// ([`Description::first_hits`](rasray_ads::Description::first_hits)). Replaces drawing.
    #[must_use]
    pub fn with_stored_hits(self) -> Self {
        Self { has_stored_hits: true, visibility: None, ..self }
    }

    /// Answers shadow rays to lights without extent by shadow maps of the scene, and also shadow rays to
    /// emitting triangles if [`Config::points`] asks for it.
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

    /// Returns the shadow maps, which answer shadow rays in place of traces.
    pub fn shadow_maps(&self) -> Option<&ShadowMaps> {
        self.shadow_maps.as_ref()
    }

    /// States that lights or triangles have moved, or will have moved by the time that the next image is
    /// recorded.
    pub fn scene_moved(&mut self) {
        self.maps_are_stale = true;
    }

    /// Returns true if [`ImagePasses::record_shadow_maps`] would record a pass.
    pub(crate) fn needs_shadow_maps(&self) -> bool {
        self.maps_are_stale && self.shadow_maps.is_some()
    }

    /// Records the drawing of shadow maps if lights or triangles moved since the maps were last recorded.
    /// Returns true if it recorded any.
    pub(crate) fn record_shadow_maps(&mut self, recorder: &mut Recorder<'_>) -> bool {
        let are_stale = std::mem::take(&mut self.maps_are_stale);
        let Some(maps) = self.shadow_maps.as_ref().filter(|_| are_stale) else { return false };
        maps.record_build(recorder);
        true
    }

    /// Returns the integrator, with the film.
    pub fn integrator(&self) -> &dyn Integrator {
        self.integrator.as_ref()
    }

    /// Returns the drawing that answers camera rays in place of traces.
    pub fn visibility(&self) -> Option<&Visibility> {
        self.visibility.as_ref()
    }

    /// Returns the film to which samples are added.
    pub fn film(&self) -> &Film {
        self.integrator.film()
    }

    /// Returns names and bytes of the buffers of an image: the film, the queues part by part, the
    /// integrator's buffers per slot, and the buffers that fetch surfaces and first hits by drawing. Shadow
    /// maps are not included.
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

    /// Shows another scene from the next recording on, in a film of the same size. Kernels are kept; shadow
    /// maps grow if there are more lights.
    ///
    /// # Errors
    /// The scene has a feature that the kernels have no code for, or out of memory.
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

    /// Returns the structure through which rays are traced, with the passes that answer rays in its place:
    /// drawing, its view of the camera, and shadow maps.
    pub(crate) fn traced<'a>(&'a self, structure: &'a dyn Structure) -> Traced<'a> {
        let maps = self.shadow_maps.as_ref().map(|maps| maps as &dyn Occluder);
        let primary = match self.has_stored_hits {
            true => FirstHits::Stored,
            false => self.visibility.as_ref().into(),
        };
        Traced::from(structure).with_primary(primary).with_occluder(maps)
    }

    /// Records the reset of the film and the counters to 0.
    pub fn record_reset(&self, recorder: &mut Recorder<'_>) {
        self.integrator.record_reset(recorder);
        if let Some(visibility) = &self.visibility {
            visibility.record_reset(recorder);
        }
    }

    /// Returns the waves of samples, in the order in which they are recorded.
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

/// Returns the number of rays of queues that have no answer, including rays that met an unbuilt structure. If
/// it is not 0, no result computed from these queues is valid.
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

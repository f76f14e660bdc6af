//! Renderer of the frames of a scene.

use std::collections::VecDeque;

use rasray_ads::{AdsError, PoolStatus, QueueCounters, Structure};
use rasray_gpu::{Device, PassTiming, Recorder, Timing};
use rasray_gpu_scene::{FramePose, GpuScene, PosePass, Sampling, ShadingFeatures, View};
use rasray_integrators::{Integrator, IntegratorError, Visibility, check_faults, check_features};
use rasray_tracer::{FrameOutcome, FrameSettings, FrameStructure, Frames, Refresh, TracerError};

use crate::image_passes::{ImagePasses, unanswered};
use crate::readback::{FilmCopy, Readback};
use crate::{FrameError, FrameScene, Samples};

/// Input of one frame.
#[derive(Clone, Debug)]
pub struct FrameInput {
    /// Camera, image size and seed. The size is that of the film.
    pub view: View,
    /// Sampling of pixels.
    pub sampling: Sampling,
    /// The scene; if absent, that of the frame before. Another scene may have any number of triangles,
    /// materials, textures and lights, if the kernels have code for its features.
    pub scene: Option<FrameScene>,
    /// Poses of everything that moves; if absent, those of the last frame of the same scene, or, if the scene
    /// had none, those of its tables.
    pub pose: Option<FramePose>,
    /// Indices of the samples of each pixel.
    pub samples: Samples,
    /// True if the samples are added to those of the frame before; false if the frame starts a new image.
    pub continues: bool,
}

/// Outcome of a frame.
#[derive(Clone, Debug)]
pub enum FrameResult {
    /// The frame has a picture.
    Picture(Picture),
    /// The frame has no picture: its build was incomplete, or its rays needed more rounds or passed more
    /// surfaces than were recorded. The next frames record more. A frame that continues this one has no
    /// picture either.
    Nothing {
        /// The pool that the frame's build lacked most; absent if the build is not the cause
        /// ([`FrameOutcome::Incomplete`]).
        pool: Option<PoolStatus>,
    },
}

/// Picture of a finished frame.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Number of the frame, from 0 in the order of submission.
    pub number: u64,
    /// The image; empty unless the renderer reads films back.
    pub film: FilmCopy,
    /// True if the frame built the structure.
    pub built: bool,
    /// True if the frame drew shadow maps.
    pub drew_maps: bool,
    /// Counters of the integrator's queues.
    pub counters: Vec<QueueCounters>,
    /// Times of passes, if they are timed.
    pub passes: Vec<PassTiming>,
}

/// State of a frame in flight.
#[derive(Clone, Copy, Debug)]
struct Pending {
    /// True if the frame adds to the film of the frame before.
    continues: bool,
    /// Number of rounds that the frame's traces were recorded with, summed over all parts.
    rounds: u32,
    /// Number of traces that the frame's waves were recorded with.
    traces: u32,
    /// True if the frame drew shadow maps.
    drew_maps: bool,
}

/// Renderer of the frames of a scene through one structure and one integrator.
///
/// A frame may bring another scene ([`FrameInput::scene`]). Structure, integrator and visibility are kept
/// and read the new scene from that frame on. Frames in flight keep the buffers of the earlier scene alive.
///
/// A frame's command buffer holds the host's data, and the memory of its slot holds results for the host. So
/// no frame in flight can overwrite data that another still reads. Only [`FrameRenderer::take`] waits, and
/// [`FrameRenderer::submit`] for structures that are built on the host.
pub struct FrameRenderer {
    device: Device,
    scene: FrameScene,
    /// Features that the kernels have code for.
    features: ShadingFeatures,
    image: ImagePasses,
    frames: Frames,
    readbacks: Vec<Readback>,
    /// Pose of this scene that was last given to the device.
    posed: Option<FramePose>,
    /// Frames in flight, the oldest first.
    pending: VecDeque<Pending>,
    /// True if the film was valid when the last frame ended.
    film_is_right: bool,
}

impl FrameRenderer {
    /// Makes a renderer of `scene`, which `pose` moves. Rays are traced through `structure`, which was made
    /// for both and is not built:
    ///
    /// - A structure over all triangles is built in each frame in which any of them moved.
    /// - Of a [`Combined`](rasray_ads::Combined) structure over the parts of [`PosePass::parts`] or
    ///   [`PosePass::objects`], a frame builds only the parts that moved.
    ///
    /// With `reads_films` each picture has its image on the host. Without, the image stays on the device, in
    /// the integrator's film.
    ///
    /// # Errors
    /// Out of memory, the device has no queue, or it cannot time passes.
    pub fn new(
        device: &Device,
        (scene, pose): (GpuScene, Option<PosePass>),
        structure: impl Into<Refresh>,
        image: impl Into<ImagePasses>,
        (settings, timing, reads_films): (FrameSettings, Timing, bool),
    ) -> Result<Self, FrameError> {
        let frames = Frames::new(device, structure, settings, timing)?;
        let features = scene.features();
        let scene = FrameScene::new(device, scene, pose, frames.slots())?;
        let image = image.into();
        let readback = |_| Readback::new(device, image.integrator(), reads_films);
        let readbacks = (0..frames.slots()).map(readback).collect::<Result<_, _>>()?;
        Ok(Self {
            device: device.clone(),
            scene,
            features,
            image,
            frames,
            readbacks,
            posed: None,
            pending: VecDeque::new(),
            film_is_right: false,
        })
    }

    /// Answers camera rays by drawing, with a [`Visibility`] made for the same scene.
    #[must_use]
    pub fn with_visibility(self, visibility: Visibility) -> Self {
        Self { image: self.image.with_visibility(Some(visibility)), ..self }
    }

    /// Answers shadow rays to lights without extent by shadow maps. A frame draws the maps if lights or
    /// triangles have moved.
    ///
    /// # Errors
    /// As [`ImagePasses::with_shadow_maps`].
    pub fn with_shadow_maps(self, config: rasray_shadow_maps::Config) -> Result<Self, FrameError> {
        let scene = self.scene.gpu().clone().allowing(self.features);
        Ok(Self { image: self.image.with_shadow_maps(&self.device, &scene, config)?, ..self })
    }

    /// Returns the scene of the last submitted frame; before the first, that of [`FrameRenderer::new`].
    pub fn scene(&self) -> &FrameScene {
        &self.scene
    }

    /// Returns the pose last submitted with this scene; absent if there was none.
    pub(crate) fn posed(&self) -> Option<&FramePose> {
        self.posed.as_ref()
    }

    /// Returns the maximum number of frames in flight.
    pub fn slots(&self) -> u32 {
        self.frames.slots()
    }

    /// Returns the integrator, with the film.
    pub fn integrator(&self) -> &dyn Integrator {
        self.image.integrator()
    }

    /// Returns the structure as it is kept over frames, with its counts.
    pub fn structure(&self) -> &FrameStructure {
        self.frames.structure()
    }

    /// Returns true if a frame can be submitted now; otherwise the oldest frame must be taken first.
    pub fn has_free_slot(&self) -> bool {
        self.frames.free_slot().is_some()
    }

    /// Makes the structure and the image passes read another scene from the next recording on.
    fn bind(&mut self, scene: &FrameScene) -> Result<(), FrameError> {
        // The kernels may have code for more features than the scene needs.
        let gpu = scene.gpu().clone().allowing(self.features);
        self.image.set_scene(&self.device, &gpu)?;
        self.frames.set_scene(gpu.binding())?;
        if !self.structure().is_in_parts() {
            return Ok(self.frames.set_geometry(gpu.geometry())?);
        }
        let Some(parts) = scene.pose().and_then(PosePass::divided) else {
            let (structure, reason) =
                (self.structure().structure().description().name, "the scene of a frame is not in parts");
            return Err(AdsError::InParts { structure, reason }.into());
        };
        Ok(self.frames.set_parts(parts)?)
    }

    /// Shows another scene from the next frame on; after an error the renderer keeps the scene before.
    fn set_scene(&mut self, scene: &FrameScene) -> Result<(), FrameError> {
        check_features(self.features, scene.gpu())?;
        if let Err(error) = self.bind(scene) {
            let before = self.scene.clone();
            // The scene before was bound already, and pools never shrink: this allocates small tables at
            // most.
            self.bind(&before)?;
            return Err(error);
        }
        self.scene = scene.clone();
        // The scene's device memory has the pose that was last recorded for it, if any was.
        self.posed = None;
        Ok(())
    }

    /// Records a frame and submits it, also if it brings another scene; returns its number.
    ///
    /// # Errors
    /// - all slots hold frames ([`TracerError::Busy`])
    /// - the view's size is not the film's, or the view lacks what the structure needs
    /// - the kernels have no code for the scene ([`IntegratorError::LeftOut`])
    /// - the scene and the structure differ in their parts
    /// - the device failed
    pub fn submit(&mut self, input: &FrameInput) -> Result<u64, FrameError> {
        if self.frames.free_slot().is_none() {
            return Err(TracerError::Busy { slots: self.frames.slots() }.into());
        }
        let film = self.image.film();
        let (film, view) = ([film.width(), film.height()], [input.view.width, input.view.height]);
        if film != view {
            return Err(IntegratorError::SizesDiffer { film, view }.into());
        }
        if let Some(scene) = input.scene.as_ref().filter(|scene| !scene.is(&self.scene)) {
            self.set_scene(scene)?;
        }
        let Self { scene, image, frames, readbacks, .. } = self;
        let moved = input.pose.as_ref().filter(|&wanted| self.posed.as_ref() != Some(wanted));
        let pass = scene.pose().filter(|pass| pass.moves());
        match (pass.filter(|pass| pass.moves_triangles()), moved, &self.posed) {
            (Some(pass), Some(moved), Some(before)) => frames.parts_moved(&pass.moved_parts(before, moved)),
            (Some(_), Some(_), None) => frames.geometry_moved(),
            _ => {}
        }
        if moved.is_some() && pass.is_some() {
            image.scene_moved();
        }
        let before = |recorder: &mut Recorder<'_>, slot: u32| {
            scene.gpu().record_staged(recorder);
            if let (Some(pass), Some(moved)) = (pass, moved) {
                pass.record(recorder, slot, moved);
            }
            scene.gpu().record_frame(recorder, &input.view, input.sampling);
        };
        let mut drew_maps = false;
        let after = |recorder: &mut Recorder<'_>, slot: u32, structure: &dyn Structure| {
            if !input.continues {
                image.record_reset(recorder);
            }
            drew_maps = image.record_shadow_maps(recorder);
            image.record(recorder, structure, input.samples)?;
            readbacks[slot as usize].record(recorder, image.integrator());
            Ok(())
        };
        let viewpoint = scene.gpu().viewpoint_of(&input.view);
        match frames.submit::<FrameError>(viewpoint, before, after) {
            Ok(number) => {
                let (rounds, traces) = (frames.structure().rounds(), image.integrator().traces_per_wave());
                self.pending.push_back(Pending { continues: input.continues, rounds, traces, drew_maps });
                scene.gpu().end_staging();
                if let Some(moved) = moved {
                    self.posed = Some(moved.clone());
                }
                Ok(number)
            }
            Err(error) => {
                // It is unknown whether the device has taken the pose.
                self.posed = None;
                self.frames.geometry_moved();
                self.image.scene_moved();
                Err(error)
            }
        }
    }

    /// Waits for the oldest frame in flight and returns its result; absent if no frame is in flight.
    ///
    /// # Errors
    /// The device failed, no sizes suffice for the structure, rays did not finish in the maximum number of
    /// rounds ([`FrameError::Unfinished`]), lists are damaged, or surfaces have too many photons around them
    /// ([`IntegratorError::Crowded`]).
    pub fn take(&mut self) -> Result<Option<FrameResult>, FrameError> {
        let ended = self.frames.take()?;
        ended.map(|ended| self.shown(ended)).transpose()
    }

    /// Takes the oldest frame like [`FrameRenderer::take`], but does not wait; absent until that frame ends.
    ///
    /// # Errors
    /// As [`FrameRenderer::take`].
    pub fn take_ended(&mut self) -> Result<Option<FrameResult>, FrameError> {
        let ended = self.frames.take_ended()?;
        ended.map(|ended| self.shown(ended)).transpose()
    }

    fn shown(&mut self, ended: rasray_tracer::EndedFrame) -> Result<FrameResult, FrameError> {
        // A new image does not depend on the film before it.
        let none = Pending { continues: false, rounds: 0, traces: 0, drew_maps: false };
        let pending = self.pending.pop_front().unwrap_or(none);
        self.film_is_right |= !pending.continues;
        let (film, counters) = self.readbacks[ended.slot as usize].read()?;
        let structure = self.frames.structure().structure();
        let unanswered = unanswered(structure, &counters)?;
        // Earlier frames may have allowed more rounds after this frame was recorded.
        let has_more_rounds =
            || self.frames.structure().rounds() > pending.rounds || structure.allow_more_rounds();
        if ended.outcome == FrameOutcome::Complete && unanswered > 0 && !has_more_rounds() {
            return Err(FrameError::Unfinished { rays: unanswered });
        }
        // Earlier frames may also have allowed more traces for surfaces that paths pass.
        let unended = u64::from(film.faults.unended);
        let integrator = self.image.integrator();
        let has_more_traces =
            || integrator.traces_per_wave() > pending.traces || integrator.allow_more_rounds();
        if ended.outcome == FrameOutcome::Complete && unended > 0 && !has_more_traces() {
            return Err(FrameError::Unfinished { rays: unended });
        }
        check_faults(&film.faults)?;
        self.film_is_right &= ended.outcome == FrameOutcome::Complete && unanswered + unended == 0;
        if !self.film_is_right {
            return Ok(FrameResult::Nothing { pool: ended.outcome.pool() });
        }
        let rasray_tracer::EndedFrame { number, built, passes, .. } = ended;
        Ok(FrameResult::Picture(Picture {
            number,
            film,
            built,
            drew_maps: pending.drew_maps,
            counters,
            passes,
        }))
    }
}

impl std::fmt::Debug for FrameRenderer {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("FrameRenderer")
            .field("image", &self.image)
            .field("frames", &self.frames)
            .finish_non_exhaustive()
    }
}

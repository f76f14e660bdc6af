//! Contract between structures and the code that traces through them.

use rasray_gpu::{BindingSet, Device, GpuError, Recorder, SetLayout};

use crate::{
    AdsError, BuildStatus, Check, Counters, Description, Domain, Geometry, Inspect, RayQueue, SceneBinding,
    Sizes, Trace, TracedPart, Viewpoint,
};

/// Report of a structure after a build.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StructureReport {
    /// Options in effect: name and value.
    pub options: Vec<(&'static str, String)>,
    /// Implementation paths chosen on this device: name and value.
    pub paths: Vec<(&'static str, String)>,
    /// Bytes allocated, by part.
    pub bytes_by_part: Vec<(&'static str, u64)>,
    /// Bytes that the formula on the structure's page gives for the counted elements.
    pub formula_bytes: u64,
    /// Bytes among those of `formula_bytes` that only diagnostics read.
    pub diagnostic_bytes: u64,
    /// Number of fragments or entries stored; absent if the structure stores none.
    pub stored: Option<u64>,
    /// Number of triangles with an area that rays pass through, because they cover no cell's centre in any
    /// view; absent if the structure does not count them.
    pub lost: Option<u64>,
}

impl StructureReport {
    /// Returns the sum over all parts.
    pub fn bytes(&self) -> u64 {
        self.bytes_by_part.iter().map(|(_, bytes)| bytes).sum()
    }

    /// Returns the bytes allocated beyond the filled ones: the part "slack", 0 if there is none.
    pub fn slack(&self) -> u64 {
        self.bytes_by_part.iter().find(|(name, _)| *name == "slack").map_or(0, |(_, bytes)| *bytes)
    }
}

/// Access for an embedder's shader to the GLSL functions in the structure's folder (`x_trace_closest`,
/// `x_trace_occluded`, `x_surface_at`, where x is the structure's prefix). They also need the geometry's set.
#[derive(Clone, Debug)]
pub struct InlineTrace<'a> {
    /// Layout of the structure's set, which the shader finds at `STRUCTURE_SET`; empty if shaders use
    /// addresses.
    pub layout: &'a SetLayout,
    /// The structure's set; absent if shaders use addresses.
    pub set: Option<&'a BindingSet>,
    /// Value of the structure's reference (`XRef`): the header's device address, zero with descriptors.
    pub address: u64,
    /// Specialisation constants of the structure: id and bits. Ids of different structures do not collide.
    pub constants: Vec<(u32, u32)>,
}

/// Acceleration structure that rays are traced through. A host records its build
/// ([`Structure::record_build`]), checks the outcome ([`Structure::check`]), and records traces
/// ([`Structure::record_trace`]).
///
/// A structure has one set of pools, so its builds and traces follow each other on the device's queue. It
/// keeps the outcomes of builds per slot: a host with n frames in flight records the build of frame k for
/// slot k mod n, and reads the slot's status after the frame's fence.
///
/// Structures are [`Send`] and [`Sync`], so a host may record on a thread of its own.
pub trait Structure: Send + Sync {
    /// Returns the facts about the structure.
    fn description(&self) -> &Description;

    /// Returns the sizes of the allocated pools.
    fn sizes(&self) -> &Sizes;

    /// Reallocates the pools to `sizes`, which come from planning or from [`Structure::check`]; does nothing
    /// if the pools have these sizes already. A reallocation loses the build. Builds that the device has yet
    /// to finish keep their statuses ([`BuildStatus::was_complete`]), and their buffers live as long as their
    /// [`rasray_gpu::Recorded`].
    ///
    /// # Errors
    /// The sizes name other pools ([`AdsError::OtherPools`]), a pool exceeds what one binding can hold, or
    /// memory is exhausted.
    fn resize(&mut self, device: &Device, sizes: &Sizes) -> Result<(), AdsError>;

    /// Replaces the triangles, which the next build reads. Until that build is complete, traces answer
    /// *not ready*, unless these are the triangles of the last build.
    ///
    /// # Errors
    /// Out of memory, no sizes suffice ([`Structure::check`]), or the geometry has other parts
    /// ([`AdsError::InParts`]).
    fn set_geometry(&mut self, device: &Device, geometry: &Geometry) -> Result<(), AdsError>;

    /// Replaces the scene by that of other triangles ([`Structure::set_geometry`]). Its surfaces and alpha
    /// masks are read from the next recording on. Pipelines are kept, so the new scene must be like the first
    /// in its number of buffers, its specialisation constants, and whether it has alpha masks. If builds read
    /// the scene, traces answer *not ready* until the next build is complete. An error changes nothing.
    ///
    /// # Errors
    /// [`AdsError::OtherScene`], or [`AdsError::NoScene`] where the structure was made without one.
    fn set_scene(&mut self, scene: &SceneBinding) -> Result<(), AdsError>;

    /// Chooses how much of their work rays count, from the next recording on. The build is kept. The kernel
    /// is made anew, which takes as long as for a new structure, unless
    /// [`Device::keep_pipelines`](rasray_gpu::Device::keep_pipelines) keeps it.
    ///
    /// # Errors
    /// The device refuses the pipeline. Earlier parts of a structure may then already count differently.
    fn set_counters(&mut self, device: &Device, counters: Counters) -> Result<(), AdsError>;

    /// Sets the number of builds whose outcomes are kept, which is 1 at first: at least 1, and one per frame
    /// in flight. Outcomes of earlier builds are lost, but the pools stay.
    ///
    /// # Errors
    /// Out of memory; nothing changes then.
    fn set_slots(&mut self, device: &Device, slots: u32) -> Result<(), AdsError>;

    /// Does the host's part of the next build, of the geometry as it is now. Call it before every
    /// [`Structure::record_build`]. It may submit and wait.
    ///
    /// # Errors
    /// The device failed, or memory does not suffice.
    fn prepare_build(&mut self, _device: &Device) -> Result<(), AdsError> {
        Ok(())
    }

    /// Returns true if a build for `built` must be repeated for `wanted`, with the same triangles, because
    /// the dependencies differ in a way that matters to the structure.
    fn is_stale(&self, built: Viewpoint, wanted: Viewpoint) -> bool {
        self.description().depends_on.are_stale(built, wanted)
    }

    /// Records a build for a viewpoint. Once the device has finished, `slot` has its status. Structures
    /// without views ignore the viewpoint.
    ///
    /// # Errors
    /// The slot does not exist ([`AdsError::Slot`]), or the structure has a view of the camera and the
    /// viewpoint has none.
    fn record_build(
        &mut self,
        recorder: &mut Recorder<'_>,
        slot: u32,
        viewpoint: Viewpoint,
    ) -> Result<(), AdsError>;

    /// Reads the outcome of the last build of a slot, after its submission has ended. From then on,
    /// [`Structure::report`] and [`Structure::rounds`] refer to this build. A slot without a build is
    /// incomplete, and [`Structure::check`] then returns the present sizes. Brute force builds nothing, so
    /// all its slots are complete once one was recorded.
    ///
    /// # Errors
    /// The slot does not exist, or host-visible memory could not be read.
    fn status(&self, slot: u32) -> Result<BuildStatus, GpuError>;

    /// Returns that the build is complete, or the sizes that it needs. Pools that grow get `headroom` percent
    /// more than their demand, as far as indices allow. Use 0 for a static scene, and 50 for a sequence of
    /// frames, so that a later frame of slightly larger demand is complete at once.
    ///
    /// # Errors
    /// No sizes suffice: [`AdsError::PoolTooLarge`], or [`AdsError::OutsideBounds`].
    fn check(&self, status: &BuildStatus, headroom: u32) -> Result<Check, AdsError>;

    /// Returns options, paths and bytes, of the build whose status was last read.
    ///
    /// # Errors
    /// Host-visible memory could not be read.
    fn report(&self) -> Result<StructureReport, GpuError>;

    /// Returns the number of rounds that a trace records: those in which nearly every ray finishes until
    /// [`Structure::allow_more_rounds`] is called; 1 if rays do not pause.
    fn rounds(&self) -> u32 {
        1
    }

    /// Raises [`Structure::rounds`], for a caller that found unfinished rays and traces again. Each round
    /// costs two dispatches, even if no ray is paused. Returns false if more rounds would not help.
    ///
    /// The number of rounds belongs to no build and changes no answer. A recording keeps its own number
    /// ([`Trace::rounds`]).
    fn allow_more_rounds(&self) -> bool {
        false
    }

    /// Records a trace of rays of `queue`. It writes each hit to the slot of its ray.
    fn record_trace(&self, recorder: &mut Recorder<'_>, queue: &RayQueue, trace: Trace<'_>);

    /// Records the lookup of the surfaces of the hits in the slots of `domain` of `queue`. After a trace
    /// through parts, `part` selects the hits on one of them, numbered in the order of the trace. If hits are
    /// triangles, any part knows the surfaces of all hits.
    ///
    /// # Errors
    /// [`AdsError::NoScene`]: the structure was made without a scene.
    fn record_surfaces(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
        part: TracedPart,
    ) -> Result<(), AdsError>;

    /// Records hits of the slots of `domain` of `queue` without a trace, for rays from the eye that the
    /// structure was built for. A hit is the nearest in the structure's view of the camera at the ray. It is
    /// as coarse as that view, even if traces are exact.
    ///
    /// # Errors
    /// [`AdsError::NoFirstHits`] if the structure has no such view.
    fn record_first_hits(
        &self,
        _recorder: &mut Recorder<'_>,
        _queue: &RayQueue,
        _domain: Domain,
    ) -> Result<(), AdsError> {
        Err(AdsError::NoFirstHits { structure: self.description().name })
    }

    /// Returns the access for an embedder's shader, valid until the next resize; absent if the structure has
    /// no functions to call. The functions check the status of the build.
    fn inline_trace(&self) -> Option<InlineTrace<'_>> {
        None
    }

    /// Returns the access to the pools, for tests and tools; absent if the structure has no pools.
    fn inspect(&self) -> Option<&dyn Inspect> {
        None
    }
}

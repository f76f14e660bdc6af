//! The contract between structures and everything that traces through them.

use rasray_gpu::{BindingSet, Device, GpuError, Recorder, SetLayout};

use crate::{
    AdsError, BuildStatus, Check, Description, Domain, Geometry, Inspect, RayQueue, SceneBinding, Sizes,
    Trace, TracedPart, Viewpoint,
};

/// Report of a structure once built.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StructureReport {
    /// Options as resolved: name and value.
    pub options: Vec<(&'static str, String)>,
    /// Paths chosen on this device: name and value.
    pub paths: Vec<(&'static str, String)>,
    /// Bytes allocated, by part.
    pub bytes_by_part: Vec<(&'static str, u64)>,
    /// Bytes the page's formula gives for what was counted.
    pub formula_bytes: u64,
    /// Bytes among these that only diagnostics read.
    pub diagnostic_bytes: u64,
    /// Fragments or entries stored; absent where the structure stores none.
    pub stored: Option<u64>,
    /// Triangles with an area that cover no cell's centre in any view, so that rays pass through them; absent
    /// where that is not counted.
    pub lost: Option<u64>,
}

impl StructureReport {
    /// Sum over all parts.
    pub fn bytes(&self) -> u64 {
        self.bytes_by_part.iter().map(|(_, bytes)| bytes).sum()
    }

    /// Bytes allocated beyond what is filled: the part "slack", 0 where there is none.
    pub fn slack(&self) -> u64 {
        self.bytes_by_part.iter().find(|(name, _)| *name == "slack").map_or(0, |(_, bytes)| *bytes)
    }
}

/// Access for a shader of one's own to the structure's GLSL functions (`x_trace_closest`, `x_trace_occluded`,
/// `x_surface_at` of the structure's folder). They also need the set of the structure's geometry.
#[derive(Clone, Debug)]
pub struct InlineTrace<'a> {
    /// Layout of the structure's set, which the shader finds at `STRUCTURE_SET`; empty by address.
    pub layout: &'a SetLayout,
    /// The set; absent by address.
    pub set: Option<&'a BindingSet>,
    /// Content of the structure's reference (`XRef`): the header's device address, zero with descriptors.
    pub address: u64,
    /// Specialisation constants of the structure: id and bits. Ids of different structures do not collide.
    pub constants: Vec<(u32, u32)>,
}

/// Acceleration structure that rays are traced through. A host records its build
/// ([`Structure::record_build`]), checks the outcome ([`Structure::check`]), and records traces
/// ([`Structure::record_trace`]).
///
/// One value has one set of pools, so its builds and traces follow each other on the device's queue. It keeps
/// the outcomes of builds per slot: a host with n frames in flight records the build of frame k for slot k
/// mod n, and reads the status of a slot after that frame's fence.
///
/// Structures are [`Send`] and [`Sync`]: a host may record on a thread of its own.
pub trait Structure: Send + Sync {
    /// Facts that do not change while it lives.
    fn description(&self) -> &Description;

    /// Sizes of the pools that are allocated.
    fn sizes(&self) -> &Sizes;

    /// Reallocates to `sizes`, which come from planning or from [`Structure::check`]; does nothing where
    /// these are the sizes already. The build is lost. Builds that the device has yet to finish keep their
    /// statuses ([`BuildStatus::was_complete`]), and what they use lives as long as their
    /// [`rasray_gpu::Recorded`].
    ///
    /// # Errors
    /// Out of memory, or a pool exceeds what one binding can hold.
    fn resize(&mut self, device: &Device, sizes: &Sizes) -> Result<(), AdsError>;

    /// Takes other triangles, which the next build reads. Until it is complete traces answer *not ready*,
    /// unless these are the triangles of the last build.
    ///
    /// # Errors
    /// Out of memory, no sizes suffice ([`Structure::check`]), or the geometry has other parts
    /// ([`AdsError::InParts`]).
    fn set_geometry(&mut self, device: &Device, geometry: &Geometry) -> Result<(), AdsError>;

    /// Takes the scene of other triangles ([`Structure::set_geometry`]), whose surfaces and alpha masks are
    /// read from the next recording on. Pipelines stay: it has alpha masks if the first scene had, and the
    /// same specialisation constants. Where a build reads the scene, traces answer *not ready* until the next
    /// build is complete. Nothing changes after an error.
    ///
    /// # Errors
    /// [`AdsError::OtherScene`], or [`AdsError::NoScene`] where the structure was made without one.
    fn set_scene(&mut self, scene: &SceneBinding) -> Result<(), AdsError>;

    /// Keeps the outcomes of this number of builds apart from now on, at least 1, which is the number at
    /// first: one per frame in flight. Outcomes of earlier builds are lost; the pools stay.
    ///
    /// # Errors
    /// Out of memory; then all is as it was.
    fn set_slots(&mut self, device: &Device, slots: u32) -> Result<(), AdsError>;

    /// Does the host's part of the next build, of the geometry as it is now; called before every
    /// [`Structure::record_build`]. It may submit and wait.
    ///
    /// # Errors
    /// The device failed, or memory does not suffice.
    fn prepare_build(&mut self, _device: &Device) -> Result<(), AdsError> {
        Ok(())
    }

    /// Returns true if a build for `built` is to be made anew for `wanted`, of the same triangles: the
    /// dependencies differ, unless the structure knows that the difference does not matter.
    fn is_stale(&self, built: Viewpoint, wanted: Viewpoint) -> bool {
        self.description().depends_on.are_stale(built, wanted)
    }

    /// Records a build for a viewpoint, whose status is that of `slot` once the device is done. Structures
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

    /// Reads the outcome of the last build of a slot, after its submission has ended. [`Structure::report`]
    /// and [`Structure::rounds`] are of this build from then on.
    ///
    /// # Errors
    /// There is no such slot, or host-visible memory could not be read.
    fn status(&self, slot: u32) -> Result<BuildStatus, GpuError>;

    /// Says that the build is complete, or the sizes it needs. Pools that grow get `headroom` percent more
    /// than their demand, as far as indices allow: 0 for a static scene; 50 for a sequence of frames, so that
    /// the next frame with a slightly larger demand is complete at once.
    ///
    /// # Errors
    /// No sizes suffice: [`AdsError::PoolTooLarge`], or [`AdsError::OutsideBounds`].
    fn check(&self, status: &BuildStatus, headroom: u32) -> Result<Check, AdsError>;

    /// Options, paths and bytes, of the build whose status was last read.
    ///
    /// # Errors
    /// Host-visible memory could not be read.
    fn report(&self) -> Result<StructureReport, GpuError>;

    /// Number of rounds in which nearly every ray is finished; 1 where rays do not pause.
    fn rounds(&self) -> u32 {
        1
    }

    /// Raises [`Structure::rounds`], for a caller that found unfinished rays and traces again. Each round
    /// costs two dispatches, also where no ray is paused. Returns false where more rounds would change
    /// nothing.
    ///
    /// Takes a shared reference, since whoever traces has no other one. The number of rounds is no part of a
    /// build and changes no answer; that of a recording stays ([`Trace::rounds`]).
    fn allow_more_rounds(&self) -> bool {
        false
    }

    /// Records a trace of rays of `queue`, whose hits are in their slots afterwards.
    fn record_trace(&self, recorder: &mut Recorder<'_>, queue: &RayQueue, trace: Trace<'_>);

    /// Records the lookup of the surfaces of the hits in the slots of `domain` of `queue`: of all, or after a
    /// trace through parts of a geometry of those on `part`, parts in the order of the trace. Where hits are
    /// triangles any part knows the surfaces of all.
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

    /// Records hits of the slots of `domain` of `queue` in place of a trace, for rays from the eye that it
    /// was built for: the nearest that its view of the camera holds at the ray, as fine as that view, also
    /// where traces are exact.
    ///
    /// # Errors
    /// [`AdsError::NoFirstHits`] where it has no such view.
    fn record_first_hits(
        &self,
        _recorder: &mut Recorder<'_>,
        _queue: &RayQueue,
        _domain: Domain,
    ) -> Result<(), AdsError> {
        Err(AdsError::NoFirstHits { structure: self.description().name })
    }

    /// Access for a shader of one's own, until the next resize; absent where it has no functions to call.
    /// These check the status of the build.
    fn inline_trace(&self) -> Option<InlineTrace<'_>> {
        None
    }

    /// Its pools, for tests and tools; absent where it has none.
    fn inspect(&self) -> Option<&dyn Inspect> {
        None
    }
}

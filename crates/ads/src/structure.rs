//! The contract between structures and everything that traces through them.

use rasray_gpu::{BindingSet, Device, GpuError, Recorder, SetLayout};

use crate::{
    AdsError, BuildStatus, Check, Description, Domain, Geometry, Inspect, RayQueue, SceneBinding, Sizes,
    Trace, TracedPart, Viewpoint,
};

/// What a structure reports once built.
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
    /// Of these, what only diagnostics read.
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

/// What a shader of one's own needs, beside the set of the geometry that the structure has, to call the structure's GLSL functions (`x_trace_closest`, `x_trace_occluded`,
/// `x_surface_at` of the structure's folder).
#[derive(Clone, Debug)]
pub struct InlineTrace<'a> {
    /// Layout of the structure's set, which the shader finds at `STRUCTURE_SET`; empty by address.
    pub layout: &'a SetLayout,
    /// The set; absent by address.
    pub set: Option<&'a BindingSet>,
    /// What the structure's reference (`XRef`) holds: the header's device address, zero with descriptors.
    pub address: u64,
    /// Specialisation constants of the structure: id and bits. Ids of different structures do not collide.
    pub constants: Vec<(u32, u32)>,
}

/// A structure that rays are traced through.
///
/// One value is one set of pools, whose builds and traces follow each other on the device's queue. What the host reads
/// of a build is kept per slot ([`Structure::set_slots`]): a host that has n frames in flight records the build of
/// frame k for slot k mod n, and reads the status of a slot after that frame's fence.
pub trait Structure {
    /// Facts that do not change while it lives.
    fn description(&self) -> &Description;

    /// What is allocated now.
    fn sizes(&self) -> &Sizes;

    /// Reallocates to `sizes`, which come from planning or from [`Structure::check`]. What was built is lost. Builds that the
    /// device has yet to finish keep their statuses ([`BuildStatus::was_complete`]), and what they use lives as long as
    /// the [`rasray_gpu::Recorded`] of their recording. Nothing happens where these are the sizes already.
    ///
    /// # Errors
    /// Out of memory, or a pool exceeds what one binding can hold.
    fn resize(&mut self, device: &Device, sizes: &Sizes) -> Result<(), AdsError>;

    /// Takes other triangles; the next build reads them. Until it is complete traces answer *not ready*: what was built is
    /// of others, unless these are the triangles that it was built for.
    ///
    /// # Errors
    /// Out of memory.
    fn set_geometry(&mut self, device: &Device, geometry: &Geometry) -> Result<(), AdsError>;

    /// Takes the scene that other triangles belong to, whose surfaces and alpha masks are read from the next recording on; the
    /// triangles are handed over by [`Structure::set_geometry`]. Pipelines stay, so the binding has what those of the first
    /// scene are compiled for: alpha masks or none, and the same specialisation constants. Where a build reads the scene, traces
    /// answer *not ready* until the next build is complete; other structures go on. Nothing changes after an error.
    ///
    /// # Errors
    /// [`AdsError::OtherScene`], or [`AdsError::NoScene`] where the structure was made without one.
    fn set_scene(&mut self, scene: &SceneBinding) -> Result<(), AdsError>;

    /// Does what only the host can do for the next build, of the geometry as it is now. Structures that are
    /// built on the device alone have nothing to do here. Unlike everything else a structure does, this may
    /// submit and wait; it comes before every [`Structure::record_build`].
    ///
    /// # Errors
    /// The device failed, or memory does not suffice.
    fn prepare_build(&mut self, _device: &Device) -> Result<(), AdsError> {
        Ok(())
    }

    /// Builds whose outcome is kept apart; 1 unless [`Structure::set_slots`] was called.
    fn slots(&self) -> u32;

    /// Keeps the outcomes of this number of builds separately from now on (at least 1): one per frame in flight.
    /// Outcomes of earlier builds are lost; the pools stay as they are.
    ///
    /// # Errors
    /// Out of memory; then all is as it was.
    fn set_slots(&mut self, device: &Device, slots: u32) -> Result<(), AdsError>;

    /// Whether a build for `built` is to be made anew for `wanted`, where the triangles are the same: the dependencies
    /// differ, unless the structure knows that the difference does not matter.
    fn is_stale(&self, built: Viewpoint, wanted: Viewpoint) -> bool {
        self.description().depends_on.are_stale(built, wanted)
    }

    /// Records a build for a viewpoint, whose status is that of `slot` once the device is done. Structures without
    /// views ignore the viewpoint.
    ///
    /// # Errors
    /// The slot does not exist ([`AdsError::Slot`]), or the structure has a view of the camera and the viewpoint has
    /// none.
    fn record_build(
        &mut self,
        recorder: &mut Recorder<'_>,
        slot: u32,
        viewpoint: Viewpoint,
    ) -> Result<(), AdsError>;

    /// Reads the outcome of the last build of a slot; [`Structure::report`] and [`Structure::rounds`] are of this build
    /// from then on. The caller has waited for the submission.
    ///
    /// # Errors
    /// There is no such slot, or host-visible memory could not be read.
    fn status(&self, slot: u32) -> Result<BuildStatus, GpuError>;

    /// Whether the build is complete, or the sizes it needs. Pools that grow get `headroom` percent more than their
    /// demand, as far as indices allow: 0 for a static scene; 50 for a sequence of frames, so that the next frame with
    /// a slightly larger demand is complete at once.
    ///
    /// # Errors
    /// No sizes suffice: [`AdsError::PoolTooLarge`], or [`AdsError::OutsideBounds`].
    fn check(&self, status: &BuildStatus, headroom: u32) -> Result<Check, AdsError>;

    /// Rounds after which any ray through this structure should be finished, unless
    /// [`Structure::allow_more_rounds`] says otherwise.
    fn rounds(&self) -> u32;

    /// Raises [`Structure::rounds`] where a ray might need more than nearly all rays do: a round costs two dispatches,
    /// also when no ray is paused. A caller that finds unfinished rays calls this and traces again; false where more
    /// rounds would change nothing.
    fn allow_more_rounds(&self) -> bool {
        false
    }

    /// Records a trace of rays of `queue`, whose hits are in their slots afterwards.
    fn record_trace(&self, recorder: &mut Recorder<'_>, queue: &RayQueue, trace: Trace<'_>);

    /// Records the lookup of the surfaces of the slots of `domain` of `queue`.
    ///
    /// # Errors
    /// The structure was created without a scene.
    fn record_surfaces(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
    ) -> Result<(), AdsError>;

    /// Records the lookup of surfaces after a trace through parts of a geometry, of which this one is `part`, in the same
    /// order. Where hits are triangles either knows all of them, so that one lookup by
    /// [`Structure::record_surfaces`] does.
    ///
    /// # Errors
    /// As [`Structure::record_surfaces`].
    fn record_surfaces_of_part(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
        _part: TracedPart,
    ) -> Result<(), AdsError> {
        self.record_surfaces(recorder, queue, domain)
    }

    /// Records hits of the slots of `domain` of `queue` in place of a trace: of rays from the eye that it was built for, what its
    /// view of the camera holds nearest to the eye at the ray. They are as fine as that view, also where traces are exact.
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

    /// How a shader of one's own traces through it, as it is until the next resize; absent where a structure has
    /// no functions to call. Whether it is ready is in its status, which its functions check.
    fn inline_trace(&self) -> Option<InlineTrace<'_>> {
        None
    }

    /// Its pools, for tests and tools; absent where a structure has none.
    fn inspect(&self) -> Option<&dyn Inspect> {
        None
    }

    /// Options, paths and bytes, of the build whose status was last read.
    ///
    /// # Errors
    /// Host-visible memory could not be read.
    fn report(&self) -> Result<StructureReport, GpuError>;
}

//! A structure whose builds and traces are recorded in frames, several of them in flight.

use std::collections::VecDeque;

use rasray_ads::{
    AdsError, Check, Counters, Geometry, GeometryParts, PoolStatus, SceneBinding, Structure, Viewpoint,
};
use rasray_gpu::{Device, Recorder};

use crate::Refresh;

/// Settings of a structure over frames in flight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameSettings {
    /// Maximum number of frames in flight, at least 1.
    pub slots: u32,
    /// Percentage by which a pool that grows exceeds its demand, so that a frame with a slightly larger
    /// demand is complete at once.
    pub headroom: u32,
}

impl Default for FrameSettings {
    /// Two frames in flight, and pools that are 50 % larger than their demand.
    fn default() -> Self {
        Self { slots: 2, headroom: 50 }
    }
}

/// Outcome of the build through which a frame was traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameOutcome {
    /// The build stored everything, so the results of the frame's traces are valid.
    Complete,
    /// The build did not store everything. Traces answered *not ready*, and the frame must not be shown. The
    /// structure has grown if that helps, and the next frame records a new build.
    Incomplete {
        /// The pool, among those of all parts, that lacked most elements, with its capacity before it grew.
        /// Absent if no counted pool lacked elements: an earlier frame enlarged the pools after the build was
        /// recorded, or the build lacked elements of a pool that is not counted because its size follows
        /// from the number of triangles. Absent too if the outcome of the build could not be read.
        pool: Option<PoolStatus>,
    },
}

impl FrameOutcome {
    /// Returns the pool that lacked most elements, if the build was incomplete and one is known.
    pub fn pool(self) -> Option<PoolStatus> {
        match self {
            Self::Complete => None,
            Self::Incomplete { pool } => pool,
        }
    }

    /// Returns the outcome of two parts taken together.
    fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Complete, outcome) | (outcome, Self::Complete) => outcome,
            (Self::Incomplete { pool }, Self::Incomplete { pool: of_other }) => {
                let pools = [pool, of_other].into_iter().flatten();
                Self::Incomplete { pool: pools.max_by_key(PoolStatus::lacking) }
            }
        }
    }
}

/// Counts over all frames of a structure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StructureCounts {
    /// Number of frames recorded.
    pub frames: u64,
    /// Number of frames that recorded a build, even if only of one part; the other frames were traced through
    /// an earlier build.
    pub builds: u64,
    /// Number of frames among `builds` that also built the static part; equal to `builds` for a structure
    /// without parts.
    pub static_builds: u64,
    /// Number of builds of single parts, summed over all frames; equal to `builds` for a structure without
    /// parts.
    pub part_builds: u64,
    /// Number of frames whose build was not complete.
    pub incomplete: u64,
    /// Number of times that pools grew.
    pub growths: u64,
}

/// The build that was recorded last.
#[derive(Clone, Copy)]
struct Built {
    number: u64,
    viewpoint: Viewpoint,
}

/// State of a part, which is built independently of the other parts.
#[derive(Default)]
struct Part {
    /// The build through which the next frame can be traced, unless something changed since.
    built: Option<Built>,
    /// Number of builds recorded so far.
    builds: u64,
    used: Vec<Option<Used>>,
    /// Number and outcome of the last build whose frame has ended. Frames end in order, so no frame that was
    /// traced through an earlier build is still in flight.
    ended: Option<(u64, FrameOutcome)>,
}

/// The build through which the frame of a slot was traced.
#[derive(Clone, Copy)]
struct Used {
    /// Number of the build.
    build: u64,
    /// True if this frame recorded the build.
    made: bool,
}

/// Structure over frames in flight, for hosts that record and submit their own frames. It records a build if
/// the last build is stale, reads the build's status when a frame has ended, and grows between frames. It
/// never submits or waits, except in [`FrameStructure::prepare`] for structures that are built on the host.
///
/// Order of calls; any other is an error:
///
/// 1. per frame, in the order of submission: [`FrameStructure::prepare`], which structures that are built on
///    the device alone do not need, then [`FrameStructure::record`] with a slot;
/// 2. after the fence of the slot, in the same order, and before the slot is recorded again:
///    [`FrameStructure::finish`].
///
/// The host may replace the triangles between frames.
pub struct FrameStructure {
    structure: Refresh,
    headroom: u32,
    slots: u32,
    /// Parts in the order in which the structure numbers them; all parts but the first move.
    parts: Vec<Part>,
    /// Slots of frames that were recorded and not finished yet, the oldest first.
    pending: VecDeque<u32>,
    counts: StructureCounts,
}

impl FrameStructure {
    /// Takes a structure of which nothing has been built yet.
    ///
    /// # Errors
    /// Out of memory.
    pub fn new(
        device: &Device,
        structure: impl Into<Refresh>,
        settings: FrameSettings,
    ) -> Result<Self, AdsError> {
        let mut structure = structure.into();
        let slots = settings.slots.max(1);
        structure.structure_mut().set_slots(device, slots)?;
        let part = |_| Part { used: vec![None; slots as usize], ..Part::default() };
        let parts = (0..structure.count()).map(part).collect();
        let (pending, counts) = (VecDeque::new(), StructureCounts::default());
        Ok(Self { structure, headroom: settings.headroom, slots, parts, pending, counts })
    }

    /// Returns the structure.
    pub fn structure(&self) -> &dyn Structure {
        self.structure.structure()
    }

    /// Returns the counts over all frames so far.
    pub fn counts(&self) -> StructureCounts {
        self.counts
    }

    /// States that the vertices have moved, or will have moved by the time that the next frame builds. For a
    /// structure in parts it means the vertices of all parts that move.
    pub fn geometry_moved(&mut self) {
        self.parts_moved(&[]);
    }

    /// States for each moving part whether its vertices moved; a part that `moved` does not cover counts as
    /// moved. The build of a part in a space of its own stays valid
    /// ([`Description::follows`](rasray_ads::Description::follows)). For a structure without parts, all
    /// vertices count as moved if any value is true or `moved` is empty.
    pub fn parts_moved(&mut self, moved: &[bool]) {
        if !self.is_in_parts() {
            if moved.is_empty() || moved.contains(&true) {
                self.parts[0].built = None;
            }
            return;
        }
        for part in 1..self.parts.len() {
            if moved.get(part - 1).copied().unwrap_or(true)
                && !self.structure.part(part).description().follows
            {
                self.parts[part].built = None;
            }
        }
    }

    /// Replaces the triangles; all parts are built again. Frames in flight keep the triangles with which they
    /// were recorded.
    ///
    /// # Errors
    /// Out of memory, or a [`Combined`](rasray_ads::Combined) structure is given another number of triangles,
    /// for which [`FrameStructure::set_parts`] must be called.
    pub fn set_geometry(&mut self, device: &Device, geometry: &Geometry) -> Result<(), AdsError> {
        self.replace(|structure| structure.set_geometry(device, geometry))
    }

    /// Replaces the triangles and their division into parts; all parts are built again.
    ///
    /// # Errors
    /// Out of memory.
    pub fn set_parts(&mut self, device: &Device, parts: &GeometryParts) -> Result<(), AdsError> {
        self.replace(|structure| structure.set_parts(device, parts))
    }

    /// Replaces the scene by the one that new triangles belong to ([`Structure::set_scene`]); all parts are
    /// built again. Frames in flight keep the scene with which they were recorded.
    ///
    /// # Errors
    /// As [`Structure::set_scene`].
    pub fn set_scene(&mut self, scene: &SceneBinding) -> Result<(), AdsError> {
        self.replace(|structure| structure.set_scene(scene))
    }

    /// Chooses how much of their work rays count, from the next recording on ([`Structure::set_counters`]).
    /// Builds are kept.
    ///
    /// # Errors
    /// As [`Structure::set_counters`].
    pub fn set_counters(&mut self, device: &Device, counters: Counters) -> Result<(), AdsError> {
        self.structure.structure_mut().set_counters(device, counters)
    }

    /// Returns the number of rounds that a trace recorded now has, summed over all parts. It is larger than
    /// that of a frame in flight if that frame may have had too few rounds ([`Structure::rounds`]).
    pub fn rounds(&self) -> u32 {
        (0..self.parts.len()).fold(0, |sum, part| self.structure.part(part).rounds().saturating_add(sum))
    }

    /// Returns true if the triangles are in parts, so that [`FrameStructure::set_parts`] replaces them.
    pub fn is_in_parts(&self) -> bool {
        self.structure.count() > 1
    }

    fn replace(&mut self, with: impl FnOnce(&mut Refresh) -> Result<(), AdsError>) -> Result<(), AdsError> {
        let sizes = self.structure().sizes().clone();
        // The builds are stale even if only one part took the new triangles before an error.
        self.parts.iter_mut().for_each(|part| part.built = None);
        with(&mut self.structure)?;
        if *self.structure().sizes() != sizes {
            self.counts.growths += 1;
        }
        Ok(())
    }

    /// Returns true if a frame from this viewpoint records a build.
    pub fn is_stale(&self, viewpoint: Viewpoint) -> bool {
        (0..self.parts.len()).any(|part| self.is_part_stale(part, viewpoint))
    }

    fn is_part_stale(&self, part: usize, viewpoint: Viewpoint) -> bool {
        let structure = self.structure.part(part);
        self.parts[part].built.is_none_or(|built| structure.is_stale(built.viewpoint, viewpoint))
    }

    /// Does the host's part of the next frame's build, if that frame builds; does nothing for structures that
    /// are built on the device alone. For a structure with
    /// [`Description::builds_on_host`](rasray_ads::Description::builds_on_host) it waits for the device, and
    /// the vertices must already be at the positions for which the structure is to be built.
    ///
    /// # Errors
    /// The device failed, or memory does not suffice.
    pub fn prepare(&mut self, device: &Device, viewpoint: Viewpoint) -> Result<(), AdsError> {
        for part in 0..self.parts.len() {
            if self.is_part_stale(part, viewpoint) {
                self.structure.change_part(part, |structure| structure.prepare_build(device))?;
            }
        }
        Ok(())
    }

    /// Records the build of a frame: of each part whose last build is stale. Everything recorded after it in
    /// the frame may be traced through [`FrameStructure::structure`]. Returns true if a build was recorded.
    ///
    /// # Errors
    /// The slot does not exist, or its last frame was not finished ([`AdsError::Slot`]); the structure was
    /// not prepared, or the structure has a view of the camera and the viewpoint has none.
    pub fn record(
        &mut self,
        recorder: &mut Recorder<'_>,
        slot: u32,
        viewpoint: Viewpoint,
    ) -> Result<bool, AdsError> {
        if slot >= self.slots || self.pending.contains(&slot) {
            return Err(self.wrong_slot(slot));
        }
        let (mut parts_made, mut static_made) = (0, false);
        for index in 0..self.parts.len() {
            let made = self.is_part_stale(index, viewpoint);
            if made {
                let build = |structure: &mut dyn Structure| structure.record_build(recorder, slot, viewpoint);
                if let Err(error) = self.structure.change_part(index, build) {
                    // The caller cannot submit this frame, so its recording is undone.
                    self.take_back(slot);
                    return Err(error);
                }
            }
            let part = &mut self.parts[index];
            if made {
                part.builds += 1;
                part.built = Some(Built { number: part.builds, viewpoint });
            }
            let build = part.built.map_or(part.builds, |built| built.number);
            part.used[slot as usize] = Some(Used { build, made });
            static_made |= made && index == 0;
            parts_made += u64::from(made);
        }
        self.pending.push_back(slot);
        self.counts.frames += 1;
        self.counts.builds += u64::from(parts_made > 0);
        self.counts.part_builds += parts_made;
        self.counts.static_builds += u64::from(static_made);
        Ok(parts_made > 0)
    }

    /// Returns the outcome of the build through which a slot's frame was traced; the caller has waited for
    /// the frame. Grows pools that were too small.
    ///
    /// # Errors
    /// The slot is not that of the oldest frame that was recorded and not finished ([`AdsError::Slot`]);
    /// nothing changes then. No sizes suffice, triangles reach out of their bounds
    /// ([`AdsError::OutsideBounds`]), or out of memory.
    pub fn finish(&mut self, device: &Device, slot: u32) -> Result<FrameOutcome, AdsError> {
        if self.pending.front() != Some(&slot) {
            return Err(self.wrong_slot(slot));
        }
        self.pending.pop_front();
        let mut outcome = FrameOutcome::Complete;
        let mut failed = None;
        for part in 0..self.parts.len() {
            match self.finish_part(device, part, slot) {
                Ok(of_part) => outcome = outcome.and(of_part),
                // The outcomes of the other parts must still be read.
                Err(error) => failed = failed.or(Some(error)),
            }
        }
        if let Some(error) = failed {
            return Err(error);
        }
        self.counts.incomplete += u64::from(outcome != FrameOutcome::Complete);
        Ok(outcome)
    }

    /// Returns the outcome of the build of one part that a slot's frame used.
    fn finish_part(&mut self, device: &Device, index: usize, slot: u32) -> Result<FrameOutcome, AdsError> {
        let Some(used) = self.parts[index].used.get_mut(slot as usize).and_then(Option::take) else {
            return Ok(FrameOutcome::Complete);
        };
        let unknown = FrameOutcome::Incomplete { pool: None };
        if used.made {
            let read = self.read(device, index, slot);
            let outcome = *read.as_ref().unwrap_or(&unknown);
            let part = &mut self.parts[index];
            part.ended = Some((used.build, outcome));
            if outcome != FrameOutcome::Complete && part.built.is_some_and(|built| built.number == used.build)
            {
                part.built = None;
            }
            read?;
        }
        let ended = self.parts[index].ended.filter(|(build, _)| *build == used.build);
        Ok(ended.map_or(unknown, |(_, outcome)| outcome))
    }

    fn wrong_slot(&self, slot: u32) -> AdsError {
        AdsError::Slot { structure: self.structure().description().name, slot, slots: self.slots }
    }

    /// States that the frame recorded last for this slot was not submitted, so that the builds it recorded do
    /// not exist. Does nothing if no frame was recorded for the slot.
    pub fn take_back(&mut self, slot: u32) {
        self.pending.retain(|pending| *pending != slot);
        for part in &mut self.parts {
            if let Some(used) = part.used.get_mut(slot as usize).and_then(Option::take)
                && used.made
            {
                part.built = None;
            }
        }
    }

    /// Reads the outcome of the build of a part in a slot, and grows the part if the build was not complete.
    fn read(&mut self, device: &Device, index: usize, slot: u32) -> Result<FrameOutcome, AdsError> {
        let structure = self.structure.part(index);
        let status = structure.status(slot)?;
        if status.was_complete {
            return Ok(FrameOutcome::Complete);
        }
        let incomplete = FrameOutcome::Incomplete { pool: status.shortest_pool() };
        match structure.check(&status, self.headroom)? {
            Check::Complete => Ok(if status.complete { FrameOutcome::Complete } else { incomplete }),
            Check::Grow(sizes) => {
                let grows = sizes != *structure.sizes();
                tracing::debug!(
                    structure = structure.description().name,
                    bytes = sizes.bytes(),
                    "grows between frames"
                );
                self.structure.change_part(index, |structure| structure.resize(device, &sizes))?;
                self.counts.growths += u64::from(grows);
                self.parts[index].built = None;
                Ok(incomplete)
            }
        }
    }
}

impl std::fmt::Debug for FrameStructure {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("FrameStructure")
            .field("structure", &self.structure().description().name)
            .field("counts", &self.counts)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A host may record frames on a thread of its own; the test fails to compile if it cannot.
    #[test]
    fn structures_go_to_another_thread() {
        fn goes<T: Send + Sync + ?Sized>() {}
        goes::<FrameStructure>();
        goes::<crate::BatchTracer>();
        goes::<dyn rasray_ads::Structure>();
    }

    #[test]
    fn parts_together_lack_what_one_of_them_lacks_most() {
        let incomplete = |lacking: Option<u64>| FrameOutcome::Incomplete {
            pool: lacking.map(|lacking| PoolStatus { name: "nodes", demand: 5 + lacking, capacity: 5 }),
        };
        let complete = FrameOutcome::Complete;
        assert_eq!(complete.and(complete), complete);
        for (one, other, both) in [
            (complete, incomplete(None), incomplete(None)),
            (complete, incomplete(Some(3)), incomplete(Some(3))),
            (incomplete(None), incomplete(Some(3)), incomplete(Some(3))),
            (incomplete(Some(7)), incomplete(Some(3)), incomplete(Some(7))),
            (incomplete(None), incomplete(None), incomplete(None)),
        ] {
            assert_eq!([one.and(other), other.and(one)], [both; 2]);
        }
    }
}

//! A structure over frames in flight.

use rasray_ads::{AdsError, Check, Geometry, Structure, Viewpoint};
use rasray_gpu::{Device, Recorder};

/// How a structure is kept over frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Keeping {
    /// Frames in flight, at least 1.
    pub slots: u32,
    /// Percent that pools grow beyond a demand, so that a frame with a little more is complete at once.
    pub headroom: u32,
}

impl Default for Keeping {
    /// Two frames in flight, half as much again.
    fn default() -> Self {
        Self { slots: 2, headroom: 50 }
    }
}

/// What became of the build that a frame was traced through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameOutcome {
    /// Everything was stored: what was traced is right.
    Complete,
    /// Something was not stored: traces answered *not ready*, and the frame must not be shown. The structure has grown
    /// where that helps, and the next frame builds anew.
    Incomplete,
}

/// Sums over frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StructureCounts {
    /// Frames recorded.
    pub frames: u64,
    /// Frames that recorded a build; the others traced through the last one.
    pub builds: u64,
    /// Frames whose build was not complete.
    pub incomplete: u64,
    /// Times that pools grew.
    pub growths: u64,
}

/// The last build that was recorded.
#[derive(Clone, Copy)]
struct Built {
    number: u64,
    viewpoint: Viewpoint,
}

/// What a slot's frame was traced through.
#[derive(Clone, Copy)]
struct Used {
    /// Number of the build.
    build: u64,
    /// Whether this frame recorded it.
    made: bool,
}

/// A structure over frames in flight: it is built where its last build is stale, its status is read when a frame has
/// ended, and it grows between frames. Nothing here submits or waits, but for the part of structures that the host
/// builds ([`FrameStructure::prepare`]), so that a host's own frames can be recorded with it.
///
/// The order of calls: per frame [`FrameStructure::record`] with a slot, in the order of submission; after the fence
/// of a slot [`FrameStructure::finish`], in the same order, before the slot is recorded again. Other triangles
/// are handed over between frames.
pub struct FrameStructure {
    structure: Box<dyn Structure>,
    headroom: u32,
    /// What the next frame can be traced through, unless something changed.
    built: Option<Built>,
    /// Builds recorded so far.
    builds: u64,
    used: Vec<Option<Used>>,
    /// The last build whose frame has ended, and whether it was complete. Frames end in order, so that none traced
    /// through an earlier one is left.
    ended: Option<(u64, bool)>,
    counts: StructureCounts,
}

impl FrameStructure {
    /// Keeps a structure, which was built for nothing yet.
    ///
    /// # Errors
    /// Out of memory.
    pub fn new(
        device: &Device,
        mut structure: Box<dyn Structure>,
        keeping: Keeping,
    ) -> Result<Self, AdsError> {
        let slots = keeping.slots.max(1);
        structure.set_slots(device, slots)?;
        Ok(Self {
            structure,
            headroom: keeping.headroom,
            built: None,
            builds: 0,
            used: vec![None; slots as usize],
            ended: None,
            counts: StructureCounts::default(),
        })
    }

    /// The structure.
    pub fn structure(&self) -> &dyn Structure {
        self.structure.as_ref()
    }

    /// Sums over all frames so far.
    pub fn counts(&self) -> StructureCounts {
        self.counts
    }

    /// The vertices have moved, or will have by the time that the next frame builds.
    pub fn geometry_moved(&mut self) {
        self.built = None;
    }

    /// Takes other triangles. Frames in flight keep those that they were recorded with.
    ///
    /// # Errors
    /// Out of memory.
    pub fn set_geometry(&mut self, device: &Device, geometry: &Geometry) -> Result<(), AdsError> {
        let sizes = self.structure.sizes().clone();
        self.structure.set_geometry(device, geometry)?;
        if *self.structure.sizes() != sizes {
            self.counts.growths += 1;
        }
        self.built = None;
        Ok(())
    }

    /// Whether a frame from this viewpoint records a build.
    pub fn is_stale(&self, viewpoint: Viewpoint) -> bool {
        let depends_on = self.structure.depends_on();
        self.built.is_none_or(|built| depends_on.are_stale(built.viewpoint, viewpoint))
    }

    /// Does what only the host can do for the build of the next frame, if that builds: for structures that are built on the
    /// device alone, nothing. Where [`Structure::builds_on_host`] says so, this waits for the device, and vertices must be
    /// where they are to be built.
    ///
    /// # Errors
    /// The device failed, or memory does not suffice.
    pub fn prepare(&mut self, device: &Device, viewpoint: Viewpoint) -> Result<(), AdsError> {
        if self.is_stale(viewpoint) { self.structure.prepare_build(device) } else { Ok(()) }
    }

    /// Records the build of a frame, unless the last one still holds. What follows in the frame may be traced through
    /// [`FrameStructure::structure`]. True where a build was recorded.
    ///
    /// # Errors
    /// There is no such slot, the structure was not prepared, or it has a view of the camera and the viewpoint has none.
    pub fn record(
        &mut self,
        recorder: &mut Recorder<'_>,
        slot: u32,
        viewpoint: Viewpoint,
    ) -> Result<bool, AdsError> {
        let slots = self.used.len() as u32;
        if slot >= slots {
            return Err(AdsError::Slot { structure: self.structure.name(), slot, slots });
        }
        let reused = if self.is_stale(viewpoint) { None } else { self.built };
        let build = match reused {
            Some(built) => built.number,
            None => {
                self.structure.record_build(recorder, slot, viewpoint)?;
                self.builds += 1;
                self.built = Some(Built { number: self.builds, viewpoint });
                self.builds
            }
        };
        let made = reused.is_none();
        self.used[slot as usize] = Some(Used { build, made });
        self.counts.frames += 1;
        self.counts.builds += u64::from(made);
        Ok(made)
    }

    /// Says what became of the build that a slot's frame was traced through; the caller has waited for the frame. Grows
    /// where pools were too small. A slot that was not recorded since is complete.
    ///
    /// # Errors
    /// No sizes suffice, triangles reach out of their bounds ([`AdsError::OutsideBounds`]), or out of memory.
    pub fn finish(&mut self, device: &Device, slot: u32) -> Result<FrameOutcome, AdsError> {
        let Some(used) = self.used.get_mut(slot as usize).and_then(Option::take) else {
            return Ok(FrameOutcome::Complete);
        };
        if used.made {
            let read = self.read(device, slot);
            let is_complete = matches!(read, Ok(true));
            self.ended = Some((used.build, is_complete));
            if !is_complete && self.built.is_some_and(|built| built.number == used.build) {
                self.built = None;
            }
            read?;
        }
        if self.ended == Some((used.build, true)) {
            return Ok(FrameOutcome::Complete);
        }
        self.counts.incomplete += 1;
        Ok(FrameOutcome::Incomplete)
    }

    /// The frame that was recorded last was not submitted: what it built does not exist.
    pub fn take_back(&mut self, slot: u32) {
        if let Some(used) = self.used.get_mut(slot as usize).and_then(Option::take)
            && used.made
        {
            self.built = None;
        }
    }

    /// Whether the build of a slot was complete; grows if not.
    fn read(&mut self, device: &Device, slot: u32) -> Result<bool, AdsError> {
        let status = self.structure.status(slot)?;
        if status.was_complete {
            return Ok(true);
        }
        match self.structure.check(&status, self.headroom)? {
            Check::Complete => Ok(status.complete),
            Check::Grow(sizes) => {
                let grows = sizes != *self.structure.sizes();
                tracing::debug!(
                    structure = self.structure.name(),
                    bytes = sizes.bytes(),
                    "grows between frames"
                );
                self.structure.resize(device, &sizes)?;
                self.counts.growths += u64::from(grows);
                self.built = None;
                Ok(false)
            }
        }
    }
}

impl std::fmt::Debug for FrameStructure {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("FrameStructure")
            .field("structure", &self.structure.name())
            .field("counts", &self.counts)
            .finish_non_exhaustive()
    }
}

//! Frames in flight, submitted to the queue of a device that rasray made.

use std::collections::VecDeque;

use rasray_ads::{AdsError, Geometry, GeometryParts, SceneBinding, Structure, Viewpoint};
use rasray_gpu::{Device, Flights, PassTiming, Recorder, Timing};

use crate::{FrameOutcome, FrameSettings, FrameStructure, Refresh, TracerError};

/// Frames of a structure in flight. Each frame records the passes that move its vertices, the build if it is
/// stale, and the passes that trace through the structure, in one submission. Nothing waits for that
/// submission until the frame is taken.
#[derive(Debug)]
pub struct Frames {
    device: Device,
    flights: Flights,
    structure: FrameStructure,
    /// Frames that were submitted and not taken yet, the oldest first.
    pending: VecDeque<Pending>,
    next: u64,
}

#[derive(Clone, Copy, Debug)]
struct Pending {
    number: u64,
    slot: u32,
    built: bool,
}

/// A frame that has ended.
#[derive(Clone, Debug)]
pub struct EndedFrame {
    /// Number of the frame, from 0 in the order of submission.
    pub number: u64,
    /// Slot of the frame. Data that its recording wrote for the host stays valid until the slot is used
    /// again.
    pub slot: u32,
    /// Outcome of the build through which the frame was traced; results are valid if it is complete.
    pub outcome: FrameOutcome,
    /// True if the frame recorded a build.
    pub built: bool,
    /// Times of the frame's passes, if they are timed.
    pub passes: Vec<PassTiming>,
}

impl Frames {
    /// Makes the loop of frames over a structure.
    ///
    /// # Errors
    /// Out of memory, the device has no queue, or it cannot time passes as asked.
    pub fn new(
        device: &Device,
        structure: impl Into<Refresh>,
        settings: FrameSettings,
        timing: Timing,
    ) -> Result<Self, TracerError> {
        let flights = Flights::new(device, settings.slots, timing)?;
        let structure = FrameStructure::new(device, structure, settings)?;
        Ok(Self { device: device.clone(), flights, structure, pending: VecDeque::new(), next: 0 })
    }

    /// Returns the structure over frames, with its counts.
    pub fn structure(&self) -> &FrameStructure {
        &self.structure
    }

    /// Returns the maximum number of frames in flight.
    pub fn slots(&self) -> u32 {
        self.flights.slots()
    }

    /// Returns the slot of the next frame; absent while all slots hold frames that were not taken.
    pub fn free_slot(&self) -> Option<u32> {
        let slot = (self.next % u64::from(self.slots())) as u32;
        (self.pending.len() < self.slots() as usize).then_some(slot)
    }

    /// States that the vertices moved, as [`FrameStructure::geometry_moved`] does.
    pub fn geometry_moved(&mut self) {
        self.structure.geometry_moved();
    }

    /// States which parts moved, as [`FrameStructure::parts_moved`] does.
    pub fn parts_moved(&mut self, moved: &[bool]) {
        self.structure.parts_moved(moved);
    }

    /// Replaces the triangles, as [`FrameStructure::set_geometry`] does.
    ///
    /// # Errors
    /// Out of memory.
    pub fn set_geometry(&mut self, geometry: &Geometry) -> Result<(), AdsError> {
        self.structure.set_geometry(&self.device, geometry)
    }

    /// Replaces the triangles and their parts, as [`FrameStructure::set_parts`] does.
    ///
    /// # Errors
    /// Out of memory.
    pub fn set_parts(&mut self, parts: &GeometryParts) -> Result<(), AdsError> {
        self.structure.set_parts(&self.device, parts)
    }

    /// Replaces the scene, as [`FrameStructure::set_scene`] does.
    ///
    /// # Errors
    /// As [`FrameStructure::set_scene`].
    pub fn set_scene(&mut self, scene: &SceneBinding) -> Result<(), AdsError> {
        self.structure.set_scene(scene)
    }

    /// Records a frame and submits it; returns its number. `before` records the passes that move vertices and
    /// comes first; `after` records the passes that trace through the structure. Both are given the slot,
    /// which is [`Frames::free_slot`]. If the host does a part of the build
    /// ([`Description::builds_on_host`](rasray_ads::Description::builds_on_host)), `before` is submitted
    /// separately and waited for.
    ///
    /// # Errors
    /// [`TracerError::Busy`]; the error that `after` returns; an error of the device, the recording or the
    /// structure. After an error no part of the frame is submitted, except `before` if it is submitted
    /// separately.
    pub fn submit<E: From<TracerError>>(
        &mut self,
        viewpoint: Viewpoint,
        before: impl FnOnce(&mut Recorder<'_>, u32),
        after: impl FnOnce(&mut Recorder<'_>, u32, &dyn Structure) -> Result<(), E>,
    ) -> Result<u64, E> {
        let slot = self.free_slot().ok_or(TracerError::Busy { slots: self.slots() })?;
        let mut before = Some(before);
        if self.structure.structure().description().builds_on_host && self.structure.is_stale(viewpoint) {
            let before = before.take();
            let moved =
                self.device.submit(|recorder| before.into_iter().for_each(|before| before(recorder, slot)));
            moved.map_err(TracerError::from)?;
        }
        self.structure.prepare(&self.device, viewpoint).map_err(TracerError::from)?;
        let Self { flights, structure, .. } = self;
        let mut refused = None;
        let submitted = flights.submit(slot, |recorder| {
            if let Some(before) = before {
                before(recorder, slot);
            }
            let recorded = structure.record(recorder, slot, viewpoint).map_err(TracerError::from);
            let recorded = recorded
                .map_err(E::from)
                .and_then(|built| after(recorder, slot, structure.structure()).map(|()| built));
            recorded.unwrap_or_else(|error| {
                recorder.refuse("the frame was refused");
                refused = Some(error);
                false
            })
        });
        let built = match (submitted, refused) {
            (Ok(built), _) => built,
            (Err(error), refused) => {
                self.structure.take_back(slot);
                return Err(refused.unwrap_or_else(|| TracerError::from(error).into()));
            }
        };
        let number = self.next;
        self.pending.push_back(Pending { number, slot, built });
        self.next += 1;
        Ok(number)
    }

    /// Waits for the oldest frame in flight and returns its outcome; the structure has grown if it was too
    /// small. Absent if no frame is in flight.
    ///
    /// # Errors
    /// The device failed, or no sizes suffice ([`FrameStructure::finish`]).
    pub fn take(&mut self) -> Result<Option<EndedFrame>, TracerError> {
        let Some(Pending { number, slot, built }) = self.pending.pop_front() else { return Ok(None) };
        let passes = self.flights.wait(slot)?.unwrap_or_default();
        let outcome = self.structure.finish(&self.device, slot)?;
        Ok(Some(EndedFrame { number, slot, outcome, built, passes }))
    }

    /// Takes the oldest frame as [`Frames::take`] does, without waiting; absent while that frame has not
    /// ended.
    ///
    /// # Errors
    /// As [`Frames::take`].
    pub fn take_ended(&mut self) -> Result<Option<EndedFrame>, TracerError> {
        match self.pending.front() {
            Some(oldest) if self.flights.is_done(oldest.slot)? => self.take(),
            _ => Ok(None),
        }
    }
}

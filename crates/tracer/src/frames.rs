//! Frames in flight on a device of one's own.

use std::collections::VecDeque;

use rasray_ads::{AdsError, Geometry, GeometryParts, SceneBinding, Structure, Viewpoint};
use rasray_gpu::{Device, Flights, PassTiming, Recorder, Timing};

use crate::{FrameOutcome, FrameSettings, FrameStructure, Refresh, TracerError};

/// Frames of a structure in flight: each records what moves its vertices, the build if that is stale, and
/// what traces through it, in one submission that nothing waits for until the frame is taken.
#[derive(Debug)]
pub struct Frames {
    device: Device,
    flights: Flights,
    structure: FrameStructure,
    /// Submitted and not taken, the oldest first.
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
    /// Its number, from 0 in the order of submission.
    pub number: u64,
    /// Its slot: what its recording wrote for the host is there until the slot is used again.
    pub slot: u32,
    /// Says whether what it traced is right.
    pub outcome: FrameOutcome,
    /// True if it recorded a build.
    pub built: bool,
    /// Times of its passes, where they are timed.
    pub passes: Vec<PassTiming>,
}

impl Frames {
    /// Frames of a structure.
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

    /// The structure, and what was counted of it.
    pub fn structure(&self) -> &FrameStructure {
        &self.structure
    }

    /// Frames that can be in flight.
    pub fn slots(&self) -> u32 {
        self.flights.slots()
    }

    /// The slot of the next frame; absent while all hold frames that were not taken.
    pub fn free_slot(&self) -> Option<u32> {
        let slot = (self.next % u64::from(self.slots())) as u32;
        (self.pending.len() < self.slots() as usize).then_some(slot)
    }

    /// As [`FrameStructure::geometry_moved`].
    pub fn geometry_moved(&mut self) {
        self.structure.geometry_moved();
    }

    /// As [`FrameStructure::parts_moved`].
    pub fn parts_moved(&mut self, moved: &[bool]) {
        self.structure.parts_moved(moved);
    }

    /// As [`FrameStructure::set_geometry`].
    ///
    /// # Errors
    /// Out of memory.
    pub fn set_geometry(&mut self, geometry: &Geometry) -> Result<(), AdsError> {
        self.structure.set_geometry(&self.device, geometry)
    }

    /// As [`FrameStructure::set_parts`].
    ///
    /// # Errors
    /// Out of memory.
    pub fn set_parts(&mut self, parts: &GeometryParts) -> Result<(), AdsError> {
        self.structure.set_parts(&self.device, parts)
    }

    /// As [`FrameStructure::set_scene`].
    ///
    /// # Errors
    /// As [`FrameStructure::set_scene`].
    pub fn set_scene(&mut self, scene: &SceneBinding) -> Result<(), AdsError> {
        self.structure.set_scene(scene)
    }

    /// Records a frame and submits it; returns its number. `before` records what moves vertices and comes
    /// first, `after` what traces through the structure; both are given the slot, which is
    /// [`Frames::free_slot`]. Where the host has a part in the build
    /// ([`Description::builds_on_host`](rasray_ads::Description::builds_on_host)), `before` is submitted by
    /// itself and waited for.
    ///
    /// # Errors
    /// [`TracerError::Busy`]; what `after` returns, or what the device, the recording or the structure
    /// reports: nothing of the frame is submitted then, but for `before` where it is submitted by itself.
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

    /// Waits for the oldest frame in flight and says what became of it; the structure has grown where it was
    /// too small. Absent where none is in flight.
    ///
    /// # Errors
    /// The device failed, or no sizes suffice ([`FrameStructure::finish`]).
    pub fn take(&mut self) -> Result<Option<EndedFrame>, TracerError> {
        let Some(Pending { number, slot, built }) = self.pending.pop_front() else { return Ok(None) };
        let passes = self.flights.wait(slot)?.unwrap_or_default();
        let outcome = self.structure.finish(&self.device, slot)?;
        Ok(Some(EndedFrame { number, slot, outcome, built, passes }))
    }

    /// As [`Frames::take`], without waiting: absent while the oldest frame has not ended.
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

//! What the rays of an integrator are traced through.

use rasray_ads::{AdsError, Domain, RayQueue, Structure, TraceMode};
use rasray_gpu::Recorder;

/// A structure for nearest hits and one for occlusion: usually the same. A different one for occlusion may be cheaper.
#[derive(Clone, Copy)]
pub struct Traced<'a> {
    /// Finds the nearest hit and its surface.
    pub closest: &'a dyn Structure,
    /// Tests for occlusion.
    pub occluded: &'a dyn Structure,
}

impl<'a> From<&'a dyn Structure> for Traced<'a> {
    fn from(structure: &'a dyn Structure) -> Self {
        Self { closest: structure, occluded: structure }
    }
}

impl<'a, S: Structure> From<&'a S> for Traced<'a> {
    fn from(structure: &'a S) -> Self {
        Self { closest: structure, occluded: structure }
    }
}

impl Traced<'_> {
    /// Records hits and surfaces of the slots of `domain`.
    ///
    /// # Errors
    /// The structure was made without a scene.
    pub(crate) fn record_closest(
        self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
    ) -> Result<(), AdsError> {
        self.closest.record_trace(recorder, queue, domain, TraceMode::Closest, self.closest.rounds());
        self.closest.record_surfaces(recorder, queue, domain)
    }

    /// Records whether rays of the slots of `domain` hit anything.
    pub(crate) fn record_occluded(self, recorder: &mut Recorder<'_>, queue: &RayQueue, domain: Domain) {
        self.occluded.record_trace(recorder, queue, domain, TraceMode::Occluded, self.occluded.rounds());
    }

    /// Allows more rounds where a structure gives rays fewer than they may need; false where that changes nothing.
    pub fn allow_more_rounds(self) -> bool {
        let closest = self.closest.allow_more_rounds();
        self.occluded.allow_more_rounds() || closest
    }
}

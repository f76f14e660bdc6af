//! What the rays of an integrator are traced through.

use rasray_ads::{AdsError, Domain, Occluder, RayQueue, Structure, TraceMode};
use rasray_gpu::Recorder;

use crate::{Visibility, Wave};

/// A structure for nearest hits, and what answers shadow rays: usually the same structure.
#[derive(Clone, Copy)]
pub struct Traced<'a> {
    /// Finds the nearest hit and its surface.
    pub closest: &'a dyn Structure,
    /// Answers shadow rays. Not used where surfaces let them pass: they need nearest hits there.
    pub occluder: &'a dyn Occluder,
    /// Finds what camera rays hit by drawing; where absent, they are traced as all others.
    pub primary: Option<&'a Visibility>,
}

impl<'a> From<&'a dyn Structure> for Traced<'a> {
    fn from(structure: &'a dyn Structure) -> Self {
        Self { closest: structure, occluder: structure, primary: None }
    }
}

impl<'a, S: Structure> From<&'a S> for Traced<'a> {
    fn from(structure: &'a S) -> Self {
        Self { closest: structure, occluder: structure, primary: None }
    }
}

impl<'a> Traced<'a> {
    /// The same with camera rays answered by `primary`.
    #[must_use]
    pub fn with_primary(self, primary: Option<&'a Visibility>) -> Self {
        Self { primary, ..self }
    }

    /// Records hits and surfaces of the camera rays of a wave.
    ///
    /// # Errors
    /// The structure was made without a scene.
    pub(crate) fn record_primary(
        self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        wave: Wave,
    ) -> Result<(), AdsError> {
        match self.primary {
            Some(visibility) => {
                visibility.record(recorder, queue, wave);
                Ok(())
            }
            None => self.record_closest(recorder, queue, Domain::First(wave.pixel_count)),
        }
    }

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
        self.occluder.record_occluded(recorder, queue, domain);
    }
}

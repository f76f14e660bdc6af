//! The structure that the rays of an integrator are traced through.

use rasray_ads::{AdsError, Domain, Occluder, RayQueue, Structure, Trace, TracedPart};
use rasray_gpu::Recorder;

use crate::{Fetch, IntegratorError, Visibility, Wave};

/// The way in which first hits of camera rays are found.
#[derive(Clone, Copy, Debug, Default)]
pub enum FirstHits<'a> {
    /// A trace, as of all other rays.
    #[default]
    Traced,
    /// Drawing.
    Drawn(&'a Visibility),
    /// The structure's view of the camera ([`Structure::record_first_hits`]).
    Stored,
}

impl<'a> From<Option<&'a Visibility>> for FirstHits<'a> {
    fn from(visibility: Option<&'a Visibility>) -> Self {
        visibility.map_or(Self::Traced, Self::Drawn)
    }
}

/// A structure, and what answers some rays in its place.
#[derive(Clone, Copy)]
pub struct Traced<'a> {
    /// Finds the nearest hit and its surface.
    pub closest: &'a dyn Structure,
    /// Answers shadow rays; where absent, they are traced. Not used where surfaces let them pass: they need
    /// nearest hits there ([`Integrator::asks_occluder`](crate::Integrator::asks_occluder)).
    pub occluder: Option<&'a dyn Occluder>,
    /// Finds what camera rays hit.
    pub primary: FirstHits<'a>,
    /// Fetches the surfaces of what is traced by drawing; where absent, the structure looks them up.
    pub fetch: Option<&'a Fetch>,
    /// Surfaces are looked up by what shades them, of the hits in the queue.
    of_hits: bool,
}

impl<'a> From<&'a dyn Structure> for Traced<'a> {
    fn from(structure: &'a dyn Structure) -> Self {
        Self { closest: structure, occluder: None, primary: FirstHits::Traced, fetch: None, of_hits: false }
    }
}

impl<'a, S: Structure> From<&'a S> for Traced<'a> {
    fn from(structure: &'a S) -> Self {
        Self { closest: structure, occluder: None, primary: FirstHits::Traced, fetch: None, of_hits: false }
    }
}

impl<'a> Traced<'a> {
    /// Answers camera rays by `primary`.
    #[must_use]
    pub fn with_primary(self, primary: impl Into<FirstHits<'a>>) -> Self {
        Self { primary: primary.into(), ..self }
    }

    /// Answers shadow rays by `occluder`.
    #[must_use]
    pub fn with_occluder(self, occluder: Option<&'a dyn Occluder>) -> Self {
        Self { occluder, ..self }
    }

    /// Fetches surfaces by `fetch`.
    #[must_use]
    pub fn with_fetch(self, fetch: Option<&'a Fetch>) -> Self {
        Self { fetch, ..self }
    }

    /// Leaves surfaces out of the queue, for a kernel that looks them up by the hits.
    ///
    /// # Errors
    /// Surfaces of the structure are not those of the triangles that its hits name.
    pub(crate) fn with_surfaces_of_hits(self) -> Result<Self, IntegratorError> {
        let structure = self.closest.description();
        if !structure.surfaces_of_triangles {
            return Err(IntegratorError::SurfacesOfHits { structure: structure.name });
        }
        Ok(Self { of_hits: true, ..self })
    }

    /// Records hits and surfaces of the camera rays of a wave.
    ///
    /// # Errors
    /// The structure was made without a scene, surfaces are drawn and its hits are fragments, or it has no
    /// first hits where those are asked for.
    pub(crate) fn record_primary(
        self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        wave: Wave,
    ) -> Result<(), AdsError> {
        let all = Domain::First(wave.pixel_count);
        match self.primary {
            FirstHits::Traced => self.record_closest(recorder, queue, all),
            FirstHits::Drawn(visibility) => {
                visibility.record(recorder, queue, wave);
                Ok(())
            }
            FirstHits::Stored => {
                self.closest.record_first_hits(recorder, queue, all)?;
                self.closest.record_surfaces(recorder, queue, all, TracedPart::Whole)
            }
        }
    }

    /// Records hits and surfaces of the slots of `domain`.
    ///
    /// # Errors
    /// The structure was made without a scene, or surfaces are drawn and its hits are fragments.
    pub(crate) fn record_closest(
        self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
    ) -> Result<(), AdsError> {
        self.closest.record_trace(recorder, queue, Trace::closest(domain));
        match self.fetch {
            Some(fetch) => fetch.record(recorder, queue, domain, self.closest.description().kind),
            None if self.of_hits => Ok(()),
            None => self.closest.record_surfaces(recorder, queue, domain, TracedPart::Whole),
        }
    }

    /// Records whether rays of the slots of `domain` hit anything.
    pub(crate) fn record_occluded(self, recorder: &mut Recorder<'_>, queue: &RayQueue, domain: Domain) {
        match self.occluder {
            Some(occluder) => occluder.record_occluded(recorder, queue, domain, self.closest),
            None => self.closest.record_trace(recorder, queue, Trace::occluded(domain)),
        }
    }
}

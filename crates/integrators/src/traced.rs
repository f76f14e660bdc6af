//! Structure through which the rays of an integrator are traced.

use rasray_ads::{AdsError, Domain, Occluder, RayQueue, Structure, Trace, TracedPart};
use rasray_gpu::Recorder;

use crate::{Fetch, IntegratorError, Visibility, Wave};

/// Method that finds the first hits of camera rays.
#[derive(Clone, Copy, Debug, Default)]
pub enum FirstHits<'a> {
    /// Tracing, as for all other rays.
    #[default]
    Traced,
    /// Drawing.
    Drawn(&'a Visibility),
    /// Use of the structure's view of the camera ([`Structure::record_first_hits`]).
    Stored,
}

impl<'a> From<Option<&'a Visibility>> for FirstHits<'a> {
    fn from(visibility: Option<&'a Visibility>) -> Self {
        visibility.map_or(Self::Traced, Self::Drawn)
    }
}

/// Structure, and the helpers that answer some rays in its place.
#[derive(Clone, Copy)]
pub struct Traced<'a> {
    /// Structure that finds the nearest hit and its surface.
    pub closest: &'a dyn Structure,
    /// Occluder that answers shadow rays; if absent, they are traced. It is not used if surfaces let shadow
    /// rays pass, since these need nearest hits
    /// ([`Integrator::asks_occluder`](crate::Integrator::asks_occluder)).
    pub occluder: Option<&'a dyn Occluder>,
    /// Method that finds the hits of camera rays.
    pub primary: FirstHits<'a>,
    /// Fetch of the surfaces of traced rays by drawing; if absent, the structure looks them up.
    pub fetch: Option<&'a Fetch>,
    /// True if the shading kernel looks up surfaces by the hits in the queue.
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
    /// Sets the method `primary` for camera rays.
    #[must_use]
    pub fn with_primary(self, primary: impl Into<FirstHits<'a>>) -> Self {
        Self { primary: primary.into(), ..self }
    }

    /// Sets `occluder` for shadow rays.
    #[must_use]
    pub fn with_occluder(self, occluder: Option<&'a dyn Occluder>) -> Self {
        Self { occluder, ..self }
    }

    /// Sets `fetch` for surfaces.
    #[must_use]
    pub fn with_fetch(self, fetch: Option<&'a Fetch>) -> Self {
        Self { fetch, ..self }
    }

    /// Leaves surfaces out of the queue, for a kernel that looks them up by the hits.
    ///
    /// # Errors
    /// An error if surfaces of the structure are not those of the triangles that its hits name.
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
    /// An error if the structure was made without a scene, if surfaces are drawn and the structure's hits are
    /// fragments, or if the structure lacks the requested first hits.
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
    /// An error if the structure was made without a scene, or surfaces are drawn and the structure's hits are
    /// fragments.
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

    /// Records occlusion tests of the rays in the slots of `domain`.
    pub(crate) fn record_occluded(self, recorder: &mut Recorder<'_>, queue: &RayQueue, domain: Domain) {
        match self.occluder {
            Some(occluder) => occluder.record_occluded(recorder, queue, domain, self.closest),
            None => self.closest.record_trace(recorder, queue, Trace::occluded(domain)),
        }
    }
}

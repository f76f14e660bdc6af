//! What answers shadow rays.

use rasray_gpu::Recorder;

use crate::{Domain, RayQueue, Structure, TraceMode};

/// What tells whether anything lies on a ray: every structure, or something made for lights alone. How it is built is its
/// own ([`Structure::record_build`](crate::Structure::record_build)).
pub trait Occluder {
    /// Records whether anything lies on the rays of the slots of `domain` of `queue`: the hit of an occluded one has some
    /// primitive, that of any other [`PRIMITIVE_NONE`](crate::PRIMITIVE_NONE). Which light a ray leads to is in
    /// [`Ray::flags`](crate::Ray::flags) ([`Ray::light`](crate::Ray::light)).
    fn record_occluded(&self, recorder: &mut Recorder<'_>, queue: &RayQueue, domain: Domain);
}

impl<S: Structure> Occluder for S {
    fn record_occluded(&self, recorder: &mut Recorder<'_>, queue: &RayQueue, domain: Domain) {
        self.record_trace(recorder, queue, domain, TraceMode::Occluded, self.rounds());
    }
}

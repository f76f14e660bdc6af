//! Contract of techniques that answer shadow rays in place of a structure.

use rasray_gpu::Recorder;

use crate::{Domain, RayQueue, Structure};

/// Test whether anything lies between a point and a light, which serves lights only. Implementations define
/// how they build it.
pub trait Occluder {
    /// Records the test whether anything lies on the rays of the slots of `domain` of `queue`. The hit of an
    /// occluded ray has some primitive, and that of any other ray [`PRIMITIVE_NONE`](crate::PRIMITIVE_NONE);
    /// the other fields of a hit have no meaning. The light that a ray leads to is in
    /// [`Ray::flags`](crate::Ray::flags) ([`Ray::light`](crate::Ray::light)). Rays that the test cannot
    /// answer are traced through `structure`. `domain` is unchanged afterwards; no slot of the queue may be
    /// selected for the next take before the call, and none is selected after it.
    fn record_occluded(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
        structure: &dyn Structure,
    );
}

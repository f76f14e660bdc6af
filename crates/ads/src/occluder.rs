//! Answers shadow rays in place of a structure.

use rasray_gpu::Recorder;

use crate::{Domain, RayQueue, Structure};

/// Test of whether anything lies between a point and a light, made for lights alone. How it is built is its
/// own.
pub trait Occluder {
    /// Records whether anything lies on the rays of the slots of `domain` of `queue`: the hit of an occluded
    /// one has some primitive, that of any other [`PRIMITIVE_NONE`](crate::PRIMITIVE_NONE), and nothing else
    /// of a hit is meant. Which light a ray leads to is in [`Ray::flags`](crate::Ray::flags)
    /// ([`Ray::light`](crate::Ray::light)). Rays that it has no answer for are traced through `structure`.
    /// `domain` stays as it is; no slot of the queue is selected for the next take before, and none after.
    fn record_occluded(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
        structure: &dyn Structure,
    );
}

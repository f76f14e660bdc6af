//! Buffers of a queue of rays, and the check of those of a host.

use rasray_gpu::{Buffer, BufferUsage};

use crate::queue::sizes;
use crate::{AdsError, QueueParts};

/// Buffers of a queue, each at the binding of its place.
pub(crate) const BUFFERS: usize = 8;

/// Place of the header among the buffers.
pub(crate) const HEADER: usize = 0;

/// Place of the steps.
pub(crate) const STEPS: usize = 7;

/// Buffers of a host that a queue is made of ([`RayQueue::from_buffers`](crate::RayQueue::from_buffers)).
/// Each is used from its start, for all slots of the queue, and may be larger; all of them have the usage
/// [`BufferUsage::STORAGE`]. No two are the same buffer.
#[derive(Clone, Debug)]
pub struct QueueBuffers {
    /// A [`Ray`](crate::Ray) per slot, 48 bytes. What the host has written there is traced.
    pub rays: Buffer,
    /// A [`Hit`](crate::Hit) per slot, 16 bytes, which traces write. Where camera rays are answered by
    /// drawing, also with the usage [`BufferUsage::TRANSFER_DST`].
    pub hits: Buffer,
    /// A [`QueueHeader`](crate::QueueHeader), with all usages ([`BufferUsage::ALL`]):
    /// [`RayQueue::record_reset`](crate::RayQueue::record_reset) is recorded before anything else of the
    /// queue, whatever it holds. Absent: one is made, which is reset.
    pub header: Option<Buffer>,
    /// A [`TraceState`](crate::TraceState) per slot, 64 bytes, of rays that pause; what it holds at first is
    /// not read. Absent: one is made.
    pub states: Option<Buffer>,
    /// Four u32 per slot, lists of slots; what it holds at first is not read. Absent: one is made.
    pub list: Option<Buffer>,
    /// A [`Surface`](crate::Surface) per slot, 128 bytes, which lookups of surfaces write. Absent: there are
    /// none, as without [`QueueParts::surfaces`].
    pub surfaces: Option<Buffer>,
    /// A [`RayWork`](crate::RayWork) per slot, 24 bytes. Absent: work is not kept per ray, as without
    /// [`QueueParts::work`].
    pub work: Option<Buffer>,
}

impl QueueBuffers {
    /// These rays and hits, and of everything else what a queue makes.
    pub fn new(rays: Buffer, hits: Buffer) -> Self {
        Self { rays, hits, header: None, states: None, list: None, surfaces: None, work: None }
    }

    /// The parts, and the buffers in the order of bindings.
    ///
    /// # Errors
    /// One of them is too small for that many slots, was not made for what it is used for, or is given twice.
    pub(crate) fn checked(self, capacity: u32) -> Result<(QueueParts, [Option<Buffer>; BUFFERS]), AdsError> {
        let Self { rays, hits, header, states, list, surfaces, work } = self;
        let parts = QueueParts { surfaces: surfaces.is_some(), work: work.is_some(), steps: 0 };
        let given = [header, Some(rays), Some(hits), states, list, surfaces, work, None];
        let wrong = |reason: String| Err(AdsError::Queue { reason });
        for (place, ((part, bytes), buffer)) in sizes(capacity, parts).into_iter().zip(&given).enumerate() {
            let Some(buffer) = buffer else { continue };
            let name = buffer.name();
            if buffer.size() < bytes {
                let has = buffer.size();
                return wrong(format!(
                    "{part} of {capacity} slots take {bytes} bytes, and buffer `{name}` has {has}"
                ));
            }
            let (usage, what) = match place {
                HEADER => (BufferUsage::ALL, "with all usages"),
                _ => (BufferUsage::STORAGE, "as a storage buffer"),
            };
            if !buffer.usage().contains(usage) {
                return wrong(format!("buffer `{name}` of {part} was not made {what}"));
            }
            let is_same =
                |other: &Option<Buffer>| other.as_ref().is_some_and(|other| other.raw() == buffer.raw());
            if given[..place].iter().any(is_same) {
                return wrong(format!("buffer `{name}` is given twice, also for {part}"));
            }
        }
        Ok((parts, given))
    }
}

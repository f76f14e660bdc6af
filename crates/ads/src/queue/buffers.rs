//! Buffers of a queue of rays, and the check of buffers that a host supplies.

use rasray_gpu::{Buffer, BufferUsage};

use crate::queue::sizes;
use crate::{AdsError, QueueParts};

/// Number of buffers of a queue; the index of a buffer is its binding.
pub(crate) const BUFFERS: usize = 8;

/// Index of the header among the buffers.
pub(crate) const HEADER: usize = 0;

/// Index of the steps among the buffers.
pub(crate) const STEPS: usize = 7;

/// Buffers of a host that a queue is made of ([`RayQueue::from_buffers`](crate::RayQueue::from_buffers)).
/// Each buffer is used from its start, for all slots of the queue, and may be larger; all have the usage
/// [`BufferUsage::STORAGE`]. No two may be the same buffer.
#[derive(Clone, Debug)]
pub struct QueueBuffers {
    /// A [`Ray`](crate::Ray) per slot, 48 bytes. Traces read the rays that the host has written.
    pub rays: Buffer,
    /// A [`Hit`](crate::Hit) per slot, 16 bytes, which traces write. If camera rays are answered by drawing,
    /// the buffer also has the usage [`BufferUsage::TRANSFER_DST`].
    pub hits: Buffer,
    /// A [`QueueHeader`](crate::QueueHeader), with all usages ([`BufferUsage::ALL`]).
    /// [`RayQueue::record_reset`](crate::RayQueue::record_reset) is recorded before any other pass of the
    /// queue, whatever the buffer contains. If absent, the queue makes one, which is reset.
    pub header: Option<Buffer>,
    /// A [`TraceState`](crate::TraceState) per slot, 64 bytes, for rays that pause; its initial contents are
    /// not read. If absent, the queue makes one.
    pub states: Option<Buffer>,
    /// Four u32 per slot, for lists of slots; the initial contents are not read. If absent, the queue makes
    /// one.
    pub list: Option<Buffer>,
    /// A [`Surface`](crate::Surface) per slot, 128 bytes, which lookups of surfaces write. If absent, the
    /// queue has none, as without [`QueueParts::surfaces`].
    pub surfaces: Option<Buffer>,
    /// A [`RayWork`](crate::RayWork) per slot, 24 bytes. If absent, work is not kept per ray, as without
    /// [`QueueParts::work`].
    pub work: Option<Buffer>,
}

impl QueueBuffers {
    /// Uses the given rays and hits; the queue makes all other buffers.
    pub fn new(rays: Buffer, hits: Buffer) -> Self {
        Self { rays, hits, header: None, states: None, list: None, surfaces: None, work: None }
    }

    /// Returns the parts, and the buffers in the order of bindings.
    ///
    /// # Errors
    /// A buffer is too small for `capacity` slots, lacks a usage, or is given twice.
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

//! Rays from the host, hits back to the host.

use rasray_ads::{
    Counters, Hit, QueueCounters, QueueHeader, QueueParts, Ray, RayQueue, RayWork, Structure, TraceMode,
};
use rasray_gpu::{Device, PassTiming, Timing};

use crate::{Replay, TracerError};

/// Traces batches of rays of any length through a queue of fixed capacity.
#[derive(Debug)]
pub struct BatchTracer {
    device: Device,
    queue: RayQueue,
}

/// Hits and what they cost.
#[derive(Clone, Debug, Default)]
pub struct TraceOutcome {
    /// One per ray, in order.
    pub hits: Vec<Hit>,
    /// Trace passes, one per chunk.
    pub passes: Vec<PassTiming>,
    /// Sums over all rays; work is zero unless the structure counts it.
    pub counters: QueueCounters,
    /// One per ray, in order; empty unless the structure counts per ray.
    pub work: Vec<RayWork>,
}

impl TraceOutcome {
    /// Milliseconds of all trace passes.
    pub fn milliseconds(&self) -> f64 {
        self.passes.iter().map(|pass| pass.milliseconds).sum()
    }
}

impl BatchTracer {
    /// A tracer whose queue holds `capacity` rays.
    ///
    /// # Errors
    /// Out of memory.
    pub fn new(device: &Device, capacity: u32) -> Result<Self, TracerError> {
        let parts = QueueParts { work: true, ..QueueParts::default() };
        Ok(Self { device: device.clone(), queue: RayQueue::with_parts(device, "batch", capacity, parts)? })
    }

    /// Traces all rays, chunk by chunk, in at most [`Structure::rounds`] rounds.
    ///
    /// # Errors
    /// The device fails, rays do not finish, or the structure is not built.
    pub fn trace(
        &self,
        structure: &dyn Structure,
        rays: &[Ray],
        mode: TraceMode,
        timing: Timing,
    ) -> Result<TraceOutcome, TracerError> {
        let rounds = structure.rounds();
        let mut outcome = TraceOutcome { hits: Vec::with_capacity(rays.len()), ..TraceOutcome::default() };
        self.device.submit(|recorder| self.queue.record_reset(recorder))?;
        for chunk in rays.chunks(self.queue.capacity() as usize) {
            let count = chunk.len() as u32;
            self.device.upload_slice(self.queue.rays(), 0, chunk)?;
            let submitted = self.device.submit_passes(timing, |recorder| {
                structure.record_trace(recorder, &self.queue, count, mode, rounds);
            })?;
            outcome.passes.extend(submitted.passes);
            outcome.hits.extend(self.device.download_as::<Hit>(self.queue.hits(), 0, chunk.len())?);
            if structure.counters() >= Counters::PerRay {
                outcome.work.extend(self.device.download_as::<RayWork>(self.queue.work(), 0, chunk.len())?);
            }
        }
        let header = self.device.download_as::<QueueHeader>(self.queue.header(), 0, 1)?;
        outcome.counters = header.first().map(RayQueue::counters).unwrap_or_default();
        if outcome.counters.not_ready > 0 {
            return Err(TracerError::NotReady { rays: outcome.counters.not_ready });
        }
        let entries = structure.status()?.corrupted;
        if entries > 0 {
            return Err(TracerError::Corrupted { structure: structure.name(), entries });
        }
        if outcome.counters.unfinished > 0 {
            return Err(TracerError::Unfinished { unfinished: outcome.counters.unfinished, rounds });
        }
        Ok(outcome)
    }

    /// Traces one ray and returns everything that the structure did for it, in at most
    /// [`Structure::rounds`] rounds. The structure was made with [`Counters::Steps`].
    ///
    /// # Errors
    /// The structure does not log steps, or the device fails.
    pub fn replay(
        &self,
        structure: &dyn Structure,
        ray: &Ray,
        mode: TraceMode,
    ) -> Result<Replay, TracerError> {
        Replay::of(&self.device, structure, ray, mode)
    }
}

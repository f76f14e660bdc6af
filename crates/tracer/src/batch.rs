//! Traces rays that the host supplies and returns their hits to the host.

use std::time::Instant;

use rasray_ads::{
    Counters, Domain, Hit, QueueCounters, QueueParts, Ray, RayQueue, RayWork, Structure, Trace, TraceMode,
};
use rasray_gpu::{Device, PassTiming, Timing};

use crate::share::Shares;
use crate::{Replay, TracerError};

/// Tracer of batches of rays of any length, through a queue of fixed capacity. It submits and waits.
///
/// The first submission to a structure is small, and later ones hold as many rays as are traced in a second.
/// The division into submissions does not change any hit.
#[derive(Debug)]
pub struct BatchTracer {
    device: Device,
    queue: RayQueue,
    shares: Shares,
}

/// Hits of a batch of rays, and the cost of their trace.
#[derive(Clone, Debug, Default)]
pub struct TraceOutcome {
    /// Hits, one per ray, in the order of the rays.
    pub hits: Vec<Hit>,
    /// Times of the trace passes, one per submission.
    pub passes: Vec<PassTiming>,
    /// Counters summed over all rays; those of work are zero unless the structure counts work.
    pub counters: QueueCounters,
    /// Work of each ray, in the order of the rays; empty unless the structure counts per ray.
    pub work: Vec<RayWork>,
}

impl TraceOutcome {
    /// Returns the sum of the durations of all trace passes, milliseconds.
    pub fn milliseconds(&self) -> f64 {
        self.passes.iter().map(|pass| pass.milliseconds).sum()
    }
}

impl BatchTracer {
    /// Makes a tracer whose queue holds `capacity` rays.
    ///
    /// # Errors
    /// Out of memory.
    pub fn new(device: &Device, capacity: u32) -> Result<Self, TracerError> {
        let parts = QueueParts { work: true, ..QueueParts::default() };
        let queue = RayQueue::with_parts(device, "batch", capacity, parts)?;
        Ok(Self { device: device.clone(), queue, shares: Shares::default() })
    }

    /// Traces all rays, one submission after another, in at most [`Structure::rounds`] rounds. If some rays
    /// did not finish and the structure allows more rounds, traces all rays again; the measurements are those
    /// of the last attempt.
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
        loop {
            let rounds = structure.rounds();
            let outcome = self.trace_once(structure, rays, mode, timing)?;
            let unfinished = outcome.counters.unfinished;
            if unfinished == 0 {
                return Ok(outcome);
            }
            if !structure.allow_more_rounds() {
                return Err(TracerError::Unfinished { unfinished, rounds });
            }
        }
    }

    fn trace_once(
        &self,
        structure: &dyn Structure,
        rays: &[Ray],
        mode: TraceMode,
        timing: Timing,
    ) -> Result<TraceOutcome, TracerError> {
        let mut outcome = TraceOutcome { hits: Vec::with_capacity(rays.len()), ..TraceOutcome::default() };
        self.device.submit(|recorder| self.queue.record_reset(recorder))?;
        let mut rest = rays;
        while !rest.is_empty() {
            let share = self.shares.of(structure.into(), self.queue.capacity()) as usize;
            let (chunk, others) = rest.split_at(share.min(rest.len()));
            rest = others;
            let count = chunk.len() as u32;
            self.device.upload_slice(self.queue.rays(), 0, chunk)?;
            let started = Instant::now();
            let submitted = self.device.submit_passes(timing, |recorder| {
                structure.record_trace(recorder, &self.queue, Trace::new(Domain::First(count), mode));
            })?;
            self.shares.learn(structure.into(), count, started.elapsed().as_secs_f64());
            outcome.passes.extend(submitted.passes);
            outcome.hits.extend(self.device.download_as::<Hit>(self.queue.hits(), 0, chunk.len())?);
            if structure.description().counters >= Counters::PerRay {
                outcome.work.extend(self.device.download_as::<RayWork>(self.queue.work(), 0, chunk.len())?);
            }
        }
        outcome.counters = self.queue.download_counters(&self.device)?;
        if outcome.counters.not_ready > 0 {
            return Err(TracerError::NotReady { rays: outcome.counters.not_ready });
        }
        let entries = outcome.counters.corrupted;
        if entries > 0 {
            return Err(TracerError::Corrupted {
                structure: structure.description().name,
                entries: entries.into(),
            });
        }
        Ok(outcome)
    }

    /// Traces one ray and returns every logged step, in at most [`Structure::rounds`] rounds. The structure
    /// must have been made with [`Counters::Steps`].
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

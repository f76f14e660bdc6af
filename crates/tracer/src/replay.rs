//! Logged steps of the traversal of one ray.

use std::fmt;

use rasray_ads::{
    Counters, Domain, Hit, QueueParts, Ray, RayQueue, RayWork, StepKind, Structure, Trace, TraceMode,
    TraceStep,
};
use rasray_gpu::Device;

use crate::TracerError;

/// Initial capacity of the log, in steps; a longer traversal is traced again with capacity for all of its
/// steps.
const FIRST_STEPS: u32 = 4096;

/// Maximum number of steps that are kept: 28 MiB. Steps beyond it are counted only.
const MOST_STEPS: u32 = 1 << 20;

/// Traversal of one ray, step by step.
#[derive(Clone, Debug)]
pub struct Replay {
    /// Name of the structure.
    pub structure: &'static str,
    /// Ray that was traced.
    pub ray: Ray,
    /// The mode of the trace: nearest hit or occlusion.
    pub mode: TraceMode,
    /// Kept steps, in the order of the traversal.
    pub steps: Vec<TraceStep>,
    /// Number of steps after the kept ones.
    pub omitted: u32,
    /// Hit of the ray; `None` if the ray did not finish or the structure is not built.
    pub hit: Option<Hit>,
    /// Work of the ray.
    pub work: RayWork,
    /// Number of dispatches that the ray took part in.
    pub rounds: u32,
}

impl Replay {
    /// Traces one ray and keeps its steps.
    pub(crate) fn of(
        device: &Device,
        structure: &dyn Structure,
        ray: &Ray,
        mode: TraceMode,
    ) -> Result<Self, TracerError> {
        if structure.description().counters != Counters::Steps {
            return Err(TracerError::NoSteps { structure: structure.description().name });
        }
        let mut capacity = FIRST_STEPS;
        loop {
            let replay = Self::with_capacity(device, structure, ray, mode, capacity)?;
            if replay.hit.is_none() && structure.allow_more_rounds() {
                continue;
            }
            if replay.omitted == 0 || capacity == MOST_STEPS {
                return Ok(replay);
            }
            capacity = capacity.saturating_add(replay.omitted).min(MOST_STEPS);
        }
    }

    fn with_capacity(
        device: &Device,
        structure: &dyn Structure,
        ray: &Ray,
        mode: TraceMode,
        capacity: u32,
    ) -> Result<Self, TracerError> {
        let parts = QueueParts { work: true, steps: capacity, ..QueueParts::default() };
        let queue = RayQueue::with_parts(device, "replay", 1, parts)?;
        device.submit(|recorder| queue.record_reset(recorder))?;
        device.upload_slice(queue.rays(), 0, &[*ray])?;
        device.submit(|recorder| {
            structure.record_trace(recorder, &queue, Trace::new(Domain::First(1), mode))
        })?;
        let counters = queue.download_counters(device)?;
        let answered = counters.unfinished == 0 && counters.not_ready == 0;
        let (steps, taken) = queue.download_steps(device)?;
        let work = device.download_as::<RayWork>(queue.work(), 0, 1)?.first().copied().unwrap_or_default();
        let hit = device.download_as::<Hit>(queue.hits(), 0, 1)?.first().copied();
        Ok(Self {
            structure: structure.description().name,
            ray: *ray,
            mode,
            omitted: taken - steps.len() as u32,
            steps,
            hit: hit.filter(|_| answered),
            work,
            rounds: work.rounds,
        })
    }

    /// Returns the sum of the work of the kept steps; equal to [`Replay::work`] if no step is omitted.
    pub fn logged_work(&self) -> RayWork {
        let count = |kind| self.steps.iter().filter(|step| step.kind() == kind).count() as u32;
        let of_cells = |step: &&TraceStep| {
            use StepKind::{Cell, Entry, Occupied, View};
            matches!(step.kind(), Cell | Entry | Occupied | View)
        };
        // A cell counts as searched if the next step reads an entry or an occupied voxel.
        let of_cells: Vec<StepKind> = self.steps.iter().filter(of_cells).map(TraceStep::kind).collect();
        let is_searched = |pair: &&[StepKind]| {
            pair[0] == StepKind::Cell && matches!(pair[1], StepKind::Entry | StepKind::Occupied)
        };
        // A ray enters a view if the step before was in another view; each part begins anew.
        let (mut view, mut views) = (None, 0);
        for step in &self.steps {
            match step.kind() {
                StepKind::Round if step.a == 0 => view = None,
                StepKind::View if step.is_view() => {
                    views += u32::from(view != Some(step.a));
                    view = Some(step.a);
                }
                _ => {}
            }
        }
        RayWork {
            cells: count(StepKind::Cell),
            entries: count(StepKind::Entry) + count(StepKind::Node),
            tests: count(StepKind::Test),
            rounds: count(StepKind::Round),
            views,
            searched: of_cells.windows(2).filter(is_searched).count() as u32,
        }
    }

    /// Returns the steps that concern a primitive, each with the step of the cell, view or node in which it
    /// occurred.
    pub fn steps_of(&self, primitive: u32) -> Vec<(Option<&TraceStep>, &TraceStep)> {
        let mut place = None;
        let mut found = Vec::new();
        for step in &self.steps {
            match step.kind() {
                StepKind::View | StepKind::Cell | StepKind::Node => place = Some(step),
                _ if step.primitive() == Some(primitive) => found.push((place, step)),
                _ => {}
            }
        }
        found
    }
}

impl fmt::Display for Replay {
    /// Writes the ray, then one step per line, indented below the step that contains it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Ray { origin, direction, t_min, t_max, .. } = self.ray;
        let asked = match self.mode {
            TraceMode::Closest => "nearest hit",
            TraceMode::Occluded => "any hit",
        };
        writeln!(f, "{}, {asked}, {} rounds", self.structure, self.rounds)?;
        writeln!(f, "from {origin:?} along {direction:?}, t {t_min} to {t_max}")?;
        let RayWork { cells, entries, tests, .. } = self.work;
        writeln!(f, "{cells} cells, {entries} entries, {tests} tests")?;
        for step in &self.steps {
            let depth = match step.kind() {
                StepKind::Round | StepKind::Pause | StepKind::End => 1,
                StepKind::View => 2,
                StepKind::Cell | StepKind::Node => 3,
                StepKind::List | StepKind::Skip | StepKind::Occupied => 4,
                _ => 5,
            };
            writeln!(f, "{:width$}{step}", "", width = 2 * depth)?;
        }
        if self.omitted > 0 {
            writeln!(f, "  … and {} further steps, beyond the capacity", self.omitted)?;
        }
        match &self.hit {
            None => writeln!(f, "no answer: the ray did not finish, or the structure is not built"),
            Some(hit) if hit.is_hit() => writeln!(f, "hit: triangle {}, t {}", hit.primitive, hit.t),
            Some(_) => writeln!(f, "miss"),
        }
    }
}

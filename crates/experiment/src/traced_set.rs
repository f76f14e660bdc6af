//! Set of rays that is traced through all systems in turns, compared with the truth, and kept if wanted.

use std::borrow::BorrowMut;
use std::time::{Duration, Instant};

use rasray_ads::{Counters, Hit, QueueCounters, Ray, StructureKind, TraceMode};
use rasray_gpu::Device;
use rasray_reference::oracle::{Outcome, Verdict};
use rasray_tracer::{BatchTracer, TraceOutcome};

use crate::contestant::Contestant;
use crate::error::ExperimentError;
use crate::evaluate::{accuracy, depth_errors, device_hits};
use crate::jobs::{Answers, Comparison, SavedSet};
use crate::passes::{Passes, median, spread};
use rasray_ray_files::{HitsFile, TrueHit};
use rasray_report::{PassOf, Run, Times};

/// Least time for which traces warm up: an operating system takes tens of milliseconds to spread the threads
/// of a software driver over all cores.
const WARM_UP: Duration = Duration::from_millis(50);

/// Largest number of rays that are traced at a time.
const BATCH: usize = 131_072;

/// Name that stands for the preset in runs of hits that were found elsewhere.
pub(super) const GIVEN: &str = "given";

/// Rays with their true answers.
pub(super) struct RaysWithTruth {
    /// Name of the set, such as `camera`.
    pub(super) name: String,
    /// Rays as the device traces them.
    pub(super) rays: Vec<Ray>,
    /// Verdicts of the oracle, one per ray.
    pub(super) verdicts: Vec<Verdict>,
}

/// Contestants that answer a set, each with the place of its cell.
#[derive(Default)]
pub(super) struct Taking<'a, 'b> {
    /// Systems, which trace it in turns.
    pub(super) systems: Vec<(usize, &'a mut Contestant<'b>)>,
    /// Hits found elsewhere, evaluated like a system's.
    pub(super) given: Vec<(usize, &'a HitsFile)>,
}

impl<'a, 'b> Taking<'a, 'b> {
    /// Selects the contestants whose cells are wanted. Places count from `first`: all `systems` with their
    /// positions in the job, of which there are `count`, then the files of hits.
    pub(super) fn of(
        first: usize,
        (contestants, count): (&'a mut [(usize, Contestant<'b>)], usize),
        given: &'a [HitsFile],
        wants: impl Fn(usize) -> bool,
    ) -> Self {
        let systems = contestants.iter_mut().map(|(position, contestant)| (first + *position, contestant));
        let given = given.iter().enumerate().map(|(position, file)| (first + count + position, file));
        Self {
            systems: systems.filter(|(place, _)| wants(*place)).collect(),
            given: given.filter(|(place, _)| wants(*place)).collect(),
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.systems.is_empty() && self.given.is_empty()
    }
}

/// Settings of the traces of every set.
#[derive(Clone, Copy)]
pub(super) struct Wanted {
    /// Number of timed traces of each set after those that warm up, at least 1.
    pub(super) repetitions: u32,
    /// Seed that the rays were drawn with.
    pub(super) seed: u32,
    /// True to make histograms.
    pub(super) figures: bool,
    /// True to keep rays, truth and hits.
    pub(super) keep: bool,
}

/// Answers of one system to one set.
#[derive(Debug, Default)]
pub struct TracedSet {
    /// Hits, one per ray.
    pub hits: Vec<Hit>,
    /// Counters of one trace of all rays.
    pub counters: QueueCounters,
    /// Times of the timed traces, milliseconds.
    pub milliseconds: Vec<f64>,
    pub(super) passes: Passes,
}

/// Traces a set through the systems, in turns, and adds a run for each to the comparison. `name_hits`
/// converts hits of the device to the ids of the truth. Returns the converted answers of each new run.
pub(super) fn compare_set(
    device: &Device,
    taking: &mut Taking<'_, '_>,
    set: &RaysWithTruth,
    wanted: Wanted,
    name_hits: impl Fn(Vec<Hit>) -> Vec<Hit>,
    comparison: &mut Comparison,
) -> Result<Vec<Answers>, ExperimentError> {
    for (_, given) in &taking.given {
        if given.hits.len() != set.rays.len() {
            return Err(ExperimentError::HitCount {
                name: given.name.clone(),
                hits: given.hits.len(),
                rays: set.rays.len(),
                set: set.name.clone(),
            });
        }
    }
    let mut answers = Vec::new();
    let mut contestants: Vec<_> =
        taking.systems.iter_mut().map(|(_, contestant)| &mut **contestant).collect();
    let traces = trace_in_turns(device, &mut contestants, &set.rays, wanted.repetitions)?;
    for ((place, contestant), mut traced) in taking.systems.iter().zip(traces) {
        traced.hits = name_hits(traced.hits);
        let mut run = run_of(device, contestant, set, &traced, wanted.seed)?;
        let kind = contestant.built.structure().description().kind;
        evaluate(&mut run, kind, &set.verdicts, &traced.hits, wanted.figures, comparison)?;
        let variant = run.variant.as_ref().map(|variant| format!(".{}", variant.replace(' ', ",")));
        let name = format!("{}-{}{}", run.system, run.preset, variant.unwrap_or_default());
        answers.push(Answers { name, kind, hits: traced.hits });
        comparison.add(*place, run);
    }
    for (place, given) in &taking.given {
        let mut run = Run {
            system: given.name.clone(),
            structure: "file".to_owned(),
            preset: GIVEN.to_owned(),
            ray_set: Some(set.name.clone()),
            ..Run::default()
        };
        evaluate(&mut run, StructureKind::Primitive, &set.verdicts, &given.hits, wanted.figures, comparison)?;
        comparison.add(*place, run);
    }
    let others = taking.given.iter().map(|(_, given)| Answers {
        name: given.name.clone(),
        kind: StructureKind::Primitive,
        hits: given.hits.clone(),
    });
    let evaluated = answers.iter().cloned().chain(others).collect();
    if wanted.keep {
        comparison.kept.sets.push(SavedSet {
            name: set.name.clone(),
            rays: set.rays.clone(),
            truth: set.verdicts.iter().map(true_hit).collect(),
            answers,
        });
    }
    Ok(evaluated)
}

/// Adds the accuracy of the hits.
fn evaluate(
    run: &mut Run,
    kind: StructureKind,
    verdicts: &[Verdict],
    hits: &[Hit],
    figures: bool,
    comparison: &mut Comparison,
) -> Result<(), ExperimentError> {
    let hits = device_hits(hits.iter().copied());
    run.accuracy = Some(accuracy(kind, verdicts, &hits)?);
    if figures {
        comparison.figures.depth_errors.push(depth_errors(comparison.runs.len(), verdicts, &hits));
    }
    Ok(())
}

/// Traces rays through all systems: once to count their work, then in turns with kernels that count nothing,
/// first to warm up and then `repetitions` times to be timed. Returns one answer for each contestant.
///
/// # Errors
/// The device fails, or rays do not finish.
pub fn trace_in_turns<'a>(
    device: &Device,
    contestants: &mut [impl BorrowMut<Contestant<'a>>],
    rays: &[Ray],
    repetitions: u32,
) -> Result<Vec<TracedSet>, ExperimentError> {
    let tracer = BatchTracer::new(device, rays.len().clamp(1, BATCH) as u32)?;
    let timing = device.best_timing();
    let mut traces = Vec::with_capacity(contestants.len());
    for contestant in contestants.iter_mut() {
        let built = &mut contestant.borrow_mut().built;
        built.set_counters(device, Counters::Sums)?;
        let counters = tracer.trace(built.structure(), rays, TraceMode::Closest, timing)?.counters;
        built.set_counters(device, Counters::Off)?;
        traces.push(TracedSet { counters, ..TracedSet::default() });
    }
    let turn = |traces: &mut [TracedSet], keep: &dyn Fn(&mut TracedSet, TraceOutcome)| {
        for (contestant, traced) in contestants.iter().zip(traces) {
            let structure = contestant.borrow().built.structure();
            keep(traced, tracer.trace(structure, rays, TraceMode::Closest, timing)?);
        }
        Ok::<_, ExperimentError>(())
    };
    // The first turn compiles kernels.
    turn(&mut traces, &|traced, outcome| traced.hits = outcome.hits)?;
    let warm = Instant::now();
    while warm.elapsed() < WARM_UP {
        turn(&mut traces, &|_, _| ())?;
    }
    for _ in 0..repetitions {
        turn(&mut traces, &|traced, outcome| {
            traced.milliseconds.push(outcome.milliseconds());
            traced.passes.repeat();
            traced.passes.add(&outcome.passes);
        })?;
    }
    Ok(traces)
}

fn run_of(
    device: &Device,
    contestant: &Contestant<'_>,
    set: &RaysWithTruth,
    traced: &TracedSet,
    seed: u32,
) -> Result<Run, ExperimentError> {
    let rays = set.rays.len() as u64;
    let trace_ms = median(&traced.milliseconds);
    let mut counters = contestant.built.counters()?;
    let per_ray = |sum: u64| (rays > 0).then(|| sum as f64 / rays as f64);
    counters.nodes_per_ray = per_ray(traced.counters.entries);
    counters.cells_per_ray = per_ray(traced.counters.cells);
    counters.tests_per_ray = per_ray(traced.counters.tests);
    let QueueCounters { cells, views, searched, .. } = traced.counters;
    counters.views_per_ray = per_ray(views).filter(|_| views > 0);
    counters.rejected_share = (cells > 0).then(|| 1.0 - searched as f64 / cells as f64);
    counters.lists.clone_from(&contestant.lists);
    counters.unfinished = Some(traced.counters.unfinished.into());
    let mut run = contestant.run(device)?;
    run.ray_set = Some(set.name.clone());
    run.seed = Some(seed);
    run.times = Times {
        timer: traced.passes.timer(),
        trace_ms: Some(trace_ms),
        rays: Some(rays),
        mrays_per_s: (trace_ms > 0.0).then(|| rays as f64 / trace_ms / 1.0e3),
        ..run.times
    };
    run.spread.extend(spread(&traced.milliseconds).map(|spread| ("trace_ms".to_owned(), spread)));
    run.stages.extend(traced.passes.stages());
    run.passes.extend(traced.passes.report(Some(PassOf::Trace)));
    run.counters = Some(counters);
    Ok(run)
}

fn true_hit(verdict: &Verdict) -> TrueHit {
    let (primitive, t, barycentrics) = match verdict.outcome {
        Outcome::Hit { primitive, t, barycentrics } => (primitive, t, barycentrics),
        Outcome::Miss => (rasray_ads::PRIMITIVE_NONE, f64::INFINITY, [0.0; 2]),
    };
    TrueHit { t, primitive, barycentrics, ambiguous: verdict.ambiguous }
}

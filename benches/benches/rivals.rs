//! Trees of this project next to Embree's: `cargo bench --bench rivals -- [SCENE] [RAYS]`.
//!
//! Prints builds and traces of equal triangles and rays, alternated between tracers in one process: medians
//! of wall time and processor time, and the errors of the answers by the exact oracle. Embree is loaded if
//! `RASRAY_EMBREE` or the system has it; otherwise its rows say how to get it. Both trace on as many threads
//! as llvmpipe has: `LP_NUM_THREADS`, or one per processor. Alpha masks and backs are hit like any other
//! surface. Times of software devices are only for ratios on that device.

use rasray_scene::Sampler;
use std::error::Error;
use std::rc::Rc;

use rasray_ads::{Ray, Structure, TraceMode};
use rasray_benches::clock::{Spent, spent};
use rasray_benches::embree::{Embree, EmbreeError, Quality, Tree, TreeOptions};
use rasray_benches::setting::{SEED, SIZE, Setting};
use rasray_experiment::{DeviceScene, RaySet, RaySource, device_hits, oracle_ray};
use rasray_gpu::Device;
use rasray_metrics::{DeviceHit, HitConfusion, Truth, median};
use rasray_reference::oracle::{Oracle, Verdict};
use rasray_reference::shading::View;
use rasray_reference::shading::random::RandomStream;
use rasray_systems::Spec;
use rasray_tracer::{BatchTracer, build_until_complete};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

const REPETITIONS: usize = 5;

/// Systems of this project: the name of the row, the system, and an option. Speeds are divided by those of
/// the first.
const SYSTEMS: [(&str, &str, Option<[&str; 2]>); 5] = [
    ("bvh, sah", "bvh", Some(["builder", "sah"])),
    ("bvh, ploc", "bvh", Some(["builder", "ploc"])),
    ("bvh, trbvh", "bvh", Some(["builder", "trbvh"])),
    ("bvh, lbvh", "bvh", Some(["builder", "lbvh"])),
    ("bricks", "bricks", None),
];

/// Trees of Embree.
const TREES: [(&str, TreeOptions); 4] = [
    ("Embree", TreeOptions { quality: Quality::Medium, robust: false }),
    ("Embree, robust", TreeOptions { quality: Quality::Medium, robust: true }),
    ("Embree, robust, low quality", TreeOptions { quality: Quality::Low, robust: true }),
    ("Embree, high quality", TreeOptions { quality: Quality::High, robust: false }),
];

/// Length of shadow rays, as a share of the scene's diagonal.
const SHADOW_LENGTH: f32 = 0.25;

/// Tracer that answers rays.
enum Tracer<'a> {
    Ours { structure: Box<dyn Structure>, batch: &'a BatchTracer },
    Theirs { tree: Rc<Tree<'a>>, width: usize },
}

/// Tracer with the times of its builds.
struct Row<'a> {
    name: String,
    tracer: Tracer<'a>,
    builds: Vec<Spent>,
}

/// Set of rays with their true answers.
struct Rays {
    name: &'static str,
    mode: TraceMode,
    rays: Vec<Ray>,
    verdicts: Vec<Verdict>,
}

impl Tracer<'_> {
    /// Traces a set, and returns the hits and the time spent: wall time of the traces alone, and processor
    /// time that includes handing over rays and hits.
    fn trace(&self, device: &Device, set: &Rays) -> Result<(Vec<Option<DeviceHit>>, Spent)> {
        let (traced, spent) = match self {
            Self::Ours { structure, batch } => {
                let trace = || batch.trace(structure.as_ref(), &set.rays, set.mode, device.best_timing());
                let (traced, spent) = spent(trace);
                let traced = traced?;
                ((traced.milliseconds(), device_hits(traced.hits)), spent)
            }
            Self::Theirs { tree, width } => {
                let (traced, spent) = spent(|| tree.trace(&set.rays, set.mode, *width));
                let traced = traced?;
                ((traced.milliseconds, traced.hits), spent)
            }
        };
        let (wall, hits) = traced;
        Ok((hits, Spent { wall, ..spent }))
    }
}

/// Returns the number of threads of llvmpipe: 0 worker threads mean the caller's thread.
fn driver_threads() -> usize {
    let named = std::env::var("LP_NUM_THREADS").ok().and_then(|text| text.parse().ok());
    named.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from)).max(1)
}

fn main() -> Result<()> {
    let Setting { name, rays: count, camera, device, stage } =
        Setting::read("cargo bench --bench rivals", "spheres:100k", 50_000)?;
    let (positions, indices) = stage.triangles(&device)?;
    let threads = driver_threads();
    println!(
        "{}, {name}, {} triangles, {count} rays, {threads} threads, medians of {REPETITIONS}",
        device.name(),
        indices.len() / 3
    );
    let oracle = Oracle::new(&positions, &indices, None)?;
    let bounds = stage.scene.geometry().bounds();
    let [width, height] = SIZE;
    let source = RaySource {
        view: &View { camera, width, height, samples: 1, seed: SEED, sampler: Sampler::Sobol },
        frame_origin: stage.scene.frame_origin(),
        bounds,
        center: stage.scene.eye(),
        oracle: &oracle,
        positions: &positions,
        indices: &indices,
        flags: Default::default(),
    };
    let sets = sets(&source, count);
    let batch = BatchTracer::new(&device, count)?;
    let embree = Embree::find(threads);
    match &embree {
        Ok(embree) => println!("{}, {} threads", embree.version(), embree.threads()),
        Err(error @ EmbreeError::Missing { .. }) => println!("Embree: skipped: {error}"),
        Err(error) => return Err(error.to_string().into()),
    }
    let rows = built(&device, &stage, (&positions, &indices), &batch, embree.as_ref().ok())?;
    println!("\n| tracer | build, wall ms | processor ms |\n|---|---|---|");
    for Row { name, builds, .. } in rows.iter().filter(|row| !row.builds.is_empty()) {
        let [wall, processor] = medians(builds);
        println!("| {name} | {} | {} |", shown(wall), shown(processor));
    }
    println!(
        "\n| rays | tracer | wall ms | processor ms | speed by processor time | missed | false | wrong triangle | lost at \
         edges | wrong at edges | t off | largest \\|dt\\|/t |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|");
    for set in &sets {
        print_set(&device, &rows, set)?;
    }
    Ok(())
}

/// Makes the sets of rays of all tables.
fn sets(source: &RaySource<'_>, count: u32) -> Vec<Rays> {
    let [lower, upper] = source.bounds;
    let diagonal = (0..3).map(|axis| (upper[axis] - lower[axis]).powi(2)).sum::<f32>().sqrt();
    let bounce = source.rays(RaySet::Bounce, count);
    let shadow = bounce.iter().map(|ray| Ray { t_max: SHADOW_LENGTH * diagonal, ..*ray }).collect();
    let sets = [
        ("camera", TraceMode::Closest, source.rays(RaySet::Camera, count)),
        ("bounce", TraceMode::Closest, bounce),
        ("edge", TraceMode::Closest, edge_rays(source, count)),
        ("shadow", TraceMode::Occluded, shadow),
    ];
    let with_truth = |(name, mode, rays): (_, _, Vec<Ray>)| {
        let verdicts = source.oracle.closest_batch(&rays.iter().map(oracle_ray).collect::<Vec<_>>());
        Rays { name, mode, rays, verdicts }
    };
    sets.into_iter().map(with_truth).collect()
}

/// Makes rays from the eye towards points on edges of triangles, as near as rounding allows. On closed
/// meshes, a test that does not treat both sides of an edge alike loses some of these rays.
fn edge_rays(source: &RaySource<'_>, count: u32) -> Vec<Ray> {
    let triangles = source.indices.as_chunks::<3>().0;
    let ray = |index| {
        let stream = RandomStream { seed: SEED, pixel: index, sample: 0 };
        let below = |dimension, limit: usize| {
            ((f64::from(stream.float(dimension)) * limit as f64) as usize).min(limit - 1)
        };
        let (triangle, edge, share) = (triangles[below(16, triangles.len())], below(17, 3), stream.float(18));
        let [a, b] = [edge, (edge + 1) % 3].map(|corner| source.positions[triangle[corner] as usize]);
        let direction = |axis| a[axis] + (b[axis] - a[axis]) * share - source.center[axis];
        Ray::new(source.center, std::array::from_fn(direction))
    };
    let count = if triangles.is_empty() { 0 } else { count };
    (0..count).map(ray).collect()
}

/// Builds all tracers, each once to warm up and then in turns.
fn built<'a>(
    device: &Device,
    stage: &DeviceScene,
    (positions, indices): (&[[f32; 3]], &[u32]),
    batch: &'a BatchTracer,
    embree: Option<&'a Embree>,
) -> Result<Vec<Row<'a>>> {
    let mut rows = Vec::new();
    for (name, system, option) in SYSTEMS {
        let options = option.iter().map(|[name, value]| ((*name).to_owned(), (*value).to_owned()));
        let structure = Spec::new(system, "robust", options)?.create(device, stage.scene.geometry(), None)?;
        let tracer = Tracer::Ours { structure, batch };
        rows.push(Row { name: name.to_owned(), tracer, builds: Vec::new() });
    }
    let mut others = Vec::new();
    for repetition in 0..=REPETITIONS {
        for Row { tracer, builds, .. } in &mut rows {
            let Tracer::Ours { structure, .. } = tracer else { continue };
            let (eye, timing) = (stage.scene.eye(), device.best_timing());
            let (outcome, spent) = spent(|| build_until_complete(device, structure.as_mut(), eye, timing));
            let wall = outcome?.host_milliseconds;
            // The first build compiles kernels and grows pools, and is not timed.
            if repetition > 0 {
                builds.push(Spent { wall, ..spent });
            }
        }
        let Some(embree) = embree else { continue };
        for (place, (name, options)) in TREES.into_iter().enumerate() {
            let (tree, spent) = spent(|| embree.build(positions, indices, options));
            let tree = Rc::new(tree?);
            if repetition == 0 {
                let tracer = Tracer::Theirs { tree, width: 1 };
                others.push(Row { name: name.to_owned(), tracer, builds: Vec::new() });
            } else {
                let Row { tracer, builds, .. }: &mut Row<'_> = &mut others[place];
                builds.push(Spent { wall: tree.build_milliseconds(), ..spent });
                *tracer = Tracer::Theirs { tree, width: 1 };
            }
        }
    }
    let widest = embree.map_or(1, Embree::packet_width);
    for row in others {
        let packets = match &row.tracer {
            Tracer::Theirs { tree, .. } if widest > 1 => Some(Row {
                name: format!("{}, {widest} at a time", row.name),
                tracer: Tracer::Theirs { tree: Rc::clone(tree), width: widest },
                builds: Vec::new(),
            }),
            _ => None,
        };
        rows.push(row);
        rows.extend(packets);
    }
    Ok(rows)
}

/// Traces a set through all tracers in turns, and prints a line for each.
fn print_set(device: &Device, rows: &[Row<'_>], set: &Rays) -> Result<()> {
    let mut traces = vec![Vec::new(); rows.len()];
    let mut answers = Vec::new();
    for repetition in 0..=REPETITIONS {
        for (row, traces) in rows.iter().zip(&mut traces) {
            let (hits, spent) = row.tracer.trace(device, set)?;
            if repetition == 0 {
                answers.push(hits);
            } else {
                traces.push(spent);
            }
        }
    }
    let baseline = traces.first().and_then(|traces| medians(traces)[1]);
    for ((row, traces), hits) in rows.iter().zip(&traces).zip(&answers) {
        let [wall, processor] = medians(traces);
        let speed = baseline.zip(processor).map(|(baseline, processor)| baseline / processor);
        let wrong = match set.mode {
            TraceMode::Closest => of_hits(&set.verdicts, hits)?,
            TraceMode::Occluded => of_shadows(&set.verdicts, hits),
        };
        println!(
            "| {} | {} | {} | {} | {} | {} |",
            set.name,
            row.name,
            shown(wall),
            shown(processor),
            shown(speed),
            wrong.join(" | ")
        );
    }
    Ok(())
}

/// Returns the errors of nearest hits, in the order of the columns.
fn of_hits(verdicts: &[Verdict], hits: &[Option<DeviceHit>]) -> Result<[String; 7]> {
    let found = HitConfusion::measure(verdicts, hits, 0.0)?;
    let counts = [
        found.missed,
        found.false_hits,
        found.wrong_primitive.unwrap_or_default(),
        found.ambiguous_lost,
        found.ambiguous_wrong,
        found.t_off,
    ];
    let [missed, false_hits, wrong, lost, edges, off] = counts.map(|rate| rate.count.to_string());
    let largest = found.dt_rel.map_or("-".to_owned(), |dt| format!("{:.1e}", dt.max));
    Ok([missed, false_hits, wrong, lost, edges, off, largest])
}

/// Returns the errors of shadow rays, which ask only whether anything is hit.
fn of_shadows(verdicts: &[Verdict], hits: &[Option<DeviceHit>]) -> [String; 7] {
    let [mut missed, mut false_hits, mut lost] = [0_u64; 3];
    for (verdict, hit) in verdicts.iter().zip(hits) {
        match (verdict.hit(), hit) {
            _ if verdict.is_ambiguous() => lost += u64::from(hit.is_none() && !verdict.admits_miss()),
            (Some(_), None) => missed += 1,
            (None, Some(_)) => false_hits += 1,
            _ => {}
        }
    }
    let absent = || "-".to_owned();
    [missed.to_string(), false_hits.to_string(), absent(), lost.to_string(), absent(), absent(), absent()]
}

/// Returns the medians of wall time and processor time, milliseconds.
fn medians(times: &[Spent]) -> [Option<f64>; 2] {
    let wall: Vec<_> = times.iter().map(|spent| spent.wall).collect();
    let processor: Vec<_> = times.iter().filter_map(|spent| spent.processor).collect();
    [median(&wall), median(&processor)]
}

fn shown(value: Option<f64>) -> String {
    value.map_or("-".to_owned(), |value| format!("{value:.2}"))
}

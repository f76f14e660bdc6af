//! Work counted per ray: it adds up to the sums, and counting changes no hit.

use rasray_ads::{BruteForce, Counters, Hit, QueueCounters, Ray, RayWork, StructureKind, TraceMode};
use rasray_gpu::Timing;
use rasray_tests::harness::Bench;
use rasray_tests::invariance::Subject;
use rasray_tests::random::Random;
use rasray_tests::shapes::ball_in_a_room;
use rasray_tracer::{BatchTracer, TraceOutcome, build_until_complete};

const EYE: [f32; 3] = [0.25, -0.125, 0.5];

const MODES: [TraceMode; 2] = [TraceMode::Closest, TraceMode::Occluded];

/// Units of work per dispatch: so few that rays pause, and enough for their rounds.
fn budget(kind: StructureKind) -> u32 {
    if kind == StructureKind::Fragment { 40 } else { 5 }
}

fn rays(count: usize) -> Vec<Ray> {
    let mut rays = Random::new(0x0077_6F72_6B00).rays(count, -3.0, 3.0);
    // Inactive slots are written too.
    rays[7].t_max = -1.0;
    rays[8].direction = [0.0; 3];
    rays
}

/// Both modes through one build, with each amount of counters. The structure is made with the first.
fn traces<const N: usize>(
    bench: &Bench,
    subject: &Subject,
    counters: [Counters; N],
    rays: &[Ray],
) -> [[TraceOutcome; 2]; N] {
    let geometry = bench.geometry(&ball_in_a_room());
    let spec = subject.spec.clone().with_counters(counters[0]).with_work_budget(budget(subject.kind));
    let mut structure = spec.create(bench.device(), &geometry, None).expect("the options are valid");
    build_until_complete(bench.device(), structure.as_mut(), EYE, Timing::None).expect("the build completes");
    // Smaller than the batch, so that slots are used again.
    let tracer = BatchTracer::new(bench.device(), 300).expect("a queue fits");
    counters.map(|counters| {
        if structure.description().counters != counters {
            structure.set_counters(bench.device(), counters).expect("the kernel is made");
        }
        MODES.map(|mode| tracer.trace(structure.as_ref(), rays, mode, Timing::None).expect("all rays finish"))
    })
}

/// Difference between work and sums.
fn difference(work: &[RayWork], sums: &QueueCounters) -> Option<String> {
    let sum = |part: fn(&RayWork) -> u32| work.iter().map(|w| u64::from(part(w))).sum::<u64>();
    let added =
        [sum(|w| w.cells), sum(|w| w.entries), sum(|w| w.tests), sum(|w| w.views), sum(|w| w.searched)];
    let expected = [sums.cells, sums.entries, sums.tests, sums.views, sums.searched];
    (added != expected).then(|| format!("{added:?} added up, {expected:?} in the header"))
}

#[test]
fn work_per_ray_adds_up_to_the_sums_and_changes_no_hit() {
    let bench = Bench::new();
    let rays = rays(1000);
    for subject in Subject::by_turns() {
        let name = subject.name();
        // A ray query counts boxes alone, and many rays meet just one.
        let least = if name == "driver-rt robust" { 1000 } else { 2000 };
        let amounts = [Counters::Sums, Counters::PerRay, Counters::Off];
        let [sums, per_ray, off] = traces(&bench, &subject, amounts, &rays);
        for (place, mode) in MODES.into_iter().enumerate() {
            let (off, sums, per_ray) = (&off[place], &sums[place], &per_ray[place]);
            assert!(off.work.is_empty() && sums.work.is_empty());
            assert_eq!(per_ray.work.len(), rays.len());
            assert_eq!(off.counters, QueueCounters::default());
            assert_eq!(sums.counters, per_ray.counters, "{name}, {mode:?}");
            assert!(sums.counters.searched <= sums.counters.cells, "{name}: {:?}", sums.counters);
            assert!(sums.counters.cells + sums.counters.tests > least, "{:?}", sums.counters);
            assert_eq!(difference(&per_ray.work, &per_ray.counters), None, "{name}, {mode:?}");
            assert!(per_ray.counters.cells + per_ray.counters.tests > least, "{:?}", per_ray.counters);
            assert!(per_ray.work.iter().all(|work| work.rounds >= 1));
            let nothing = RayWork { rounds: 1, ..RayWork::default() };
            assert_eq!([per_ray.work[7], per_ray.work[8]], [nothing; 2], "{name}: inactive rays");
            // Ray queries cannot pause.
            if !["brute-force robust", "driver-rt robust"].contains(&name.as_str()) {
                assert!(per_ray.work.iter().any(|work| work.rounds > 1), "{name}: no ray paused");
            }
            let hits = |outcome: &TraceOutcome| {
                let key = |hit: &Hit| match mode {
                    TraceMode::Closest => (hit.t.to_bits(), hit.primitive),
                    TraceMode::Occluded => (0, u32::from(hit.is_hit())),
                };
                outcome.hits.iter().map(key).collect::<Vec<_>>()
            };
            assert_eq!(hits(off), hits(per_ray), "{name}, {mode:?}");
            assert_eq!(hits(off), hits(sums), "{name}, {mode:?}");
            // One unit more or less on any ray is noticed.
            let mut wrong = per_ray.work.clone();
            wrong[500].tests += 1;
            assert!(difference(&wrong, &per_ray.counters).is_some());
            wrong[500].tests -= 1;
            wrong[499].cells = wrong[499].cells.wrapping_sub(1);
            assert!(difference(&wrong, &per_ray.counters).is_some());
        }
    }
}

/// A wall on the face +z, a ray in front of it that crosses its cells, and what else stretches the bounds so
/// far.
#[test]
fn cells_are_rejected_by_their_bounds_and_by_nothing_else() {
    const SIDE: u32 = 16;
    let bench = Bench::new();
    // On the face its corners are (-0.64, -1.2), (0.64, -1.2) and (0, 4).
    let wall = [[-3.2, -6.0, 5.0], [3.2, -6.0, 5.0], [0.0, 20.0, 5.0]];
    let aside = [[9.0, -0.5, 1.5], [9.0, 0.5, 1.5], [9.0, 0.0, 2.0]];
    let geometry = bench.geometry(&[wall, aside]);
    // From column 3 to column 12 of the row whose centre is at 11/16, at a depth of 2.
    let row = 11.0 / 16.0;
    let mut ray = Ray::new([-1.2, 2.0 * row, 2.0], [1.0, 0.0, 0.0]);
    ray.t_max = 2.4;
    let config = |skip| rasray_abuffer::Config {
        skip,
        counters: Counters::PerRay,
        ..rasray_abuffer::Config::at_centres(SIDE)
    };
    let work = |skip, ray| {
        let mut structure = rasray_abuffer::ABuffer::new(bench.device(), config(skip), &geometry, None)
            .expect("the options are valid");
        build_until_complete(bench.device(), &mut structure, [0.0; 3], Timing::None)
            .expect("the build completes");
        let outcome = bench.trace(&structure, &[ray]);
        assert!(!outcome.hits[0].is_hit());
        outcome.work[0]
    };
    let covered = (3..=12)
        .map(|column| (2.0 * f64::from(column) + 1.0) / f64::from(SIDE) - 1.0)
        .filter(|x| x.abs() < 0.64 * (4.0 - f64::from(row)) / 5.2)
        .count() as u32;
    assert_eq!(covered, 6, "columns 5 to 10");
    let (skipping, reading) = (work(true, ray), work(false, ray));
    assert_eq!((skipping.views, skipping.cells, skipping.searched, skipping.entries), (1, 10, 0, 0));
    assert_eq!((reading.views, reading.cells, reading.searched, reading.entries), (1, 10, covered, covered));
    // A ray that crosses a diagonal of the face is followed in several segments and stays in the view.
    ray.origin[1] = 2.0 * 3.0 / 16.0;
    assert_eq!(work(true, ray).views, 1);
    // Through a layered depth cube a ray enters all three views.
    let mut cube = rasray_ldc::LayeredDepthCube::new(
        bench.device(),
        rasray_ldc::Config { counters: Counters::PerRay, ..rasray_ldc::Config::robust(SIDE) },
        &geometry,
        None,
    )
    .expect("the options are valid");
    build_until_complete(bench.device(), &mut cube, [0.0; 3], Timing::None).expect("the build completes");
    assert_eq!(bench.trace(&cube, &[ray]).work[0].views, 3);
}

/// A structure that counts per ray may trace a queue without capacity for it: nothing is written past its
/// end.
#[test]
fn a_queue_without_a_buffer_for_work_is_left_alone() {
    let bench = Bench::new();
    let rays = rays(200);
    let geometry = bench.geometry(&ball_in_a_room());
    let structure =
        BruteForce::new(bench.device(), &geometry, None, Counters::PerRay).expect("pipelines can be made");
    let (hits, counters) =
        rasray_tests::conformance::trace_in_rounds(&bench, &structure, &rays, TraceMode::Closest, 4);
    assert_eq!((counters.unfinished, counters.not_ready), (0, 0));
    let expected = bench.trace(&structure, &rays);
    assert_eq!(hits, expected.hits);
    assert_eq!(counters, expected.counters);
}

//! Options that may not change a hit of the A-buffer: every one is switched alone, and hits are compared
//! bit for bit.

use rasray_abuffer::{ABuffer, Accept, Addressing, Config, Coverage, March, Storage, cell_count};
use rasray_ads::{Counters, Hit, Ray, Structure, TraceMode};
use rasray_gpu::Timing;
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::Bench;
use rasray_tests::invariance::{EYE, rays, scene};
use rasray_tests::random::Random;
use rasray_tests::shapes::Triangle;
use rasray_tests::tier::{first, is_full};
use rasray_tracer::build_until_complete;

/// Enough for the smallest budget below: a ray has at most a few thousand work units here.
const ROUNDS: u32 = 700;
const RESOLUTION: u32 = 24;

/// The repaired structure.
fn robust() -> Config {
    Config { fragments: Some(40_000), ..Config::at_centres(RESOLUTION) }
}

/// The published march and acceptance.
fn sampled() -> Config {
    Config { march: March::Samples, accept: Accept::Interval, coverage: Coverage::Hardware, ..robust() }
}

type Change = fn(Config) -> Config;

/// Number of [`CHANGES`] tried in the quick tier: the first ones try every option in company.
const IN_COMPANY: usize = 8;

/// One change per row.
const CHANGES: &[(&str, Change)] = &[
    ("sb, address, 7 units per dispatch", |config| Config {
        storage: Storage::Sb,
        addressing: Addressing::Address,
        work_budget: Some(7),
        ..config
    }),
    ("paged, 8 per page, 1 bucket, 7 units per dispatch", |config| Config {
        storage: Storage::Paged,
        page: 8,
        buckets: 1,
        work_budget: Some(7),
        ..config
    }),
    ("dll, inline, skip off", |config| Config { storage: Storage::Dll, inline: true, skip: false, ..config }),
    ("llb, 32 buckets, sort off", |config| Config {
        storage: Storage::Llb,
        buckets: 32,
        sort: false,
        ..config
    }),
    ("ll, 64 units per dispatch", |config| Config { storage: Storage::Ll, work_budget: Some(64), ..config }),
    ("paged, 1 per page, inline", |config| Config {
        storage: Storage::Paged,
        page: 1,
        inline: true,
        ..config
    }),
    ("paged, address, capacity for one page at first", |config| Config {
        storage: Storage::Paged,
        addressing: Addressing::Address,
        fragments: Some(1),
        ..config
    }),
    ("counters per ray", |config| Config { counters: Counters::PerRay, ..config }),
    ("repeated", |config| config),
    ("repeated again", |config| config),
    ("sort off", |config| Config { sort: false, ..config }),
    ("skip off", |config| Config { skip: false, ..config }),
    ("sort and skip off", |config| Config { sort: false, skip: false, ..config }),
    ("1 bucket", |config| Config { buckets: 1, ..config }),
    ("2 buckets", |config| Config { buckets: 2, ..config }),
    ("8 buckets", |config| Config { buckets: 8, ..config }),
    ("12 buckets", |config| Config { buckets: 12, ..config }),
    ("32 buckets", |config| Config { buckets: 32, ..config }),
    ("1 bucket, sort off", |config| Config { buckets: 1, sort: false, ..config }),
    ("ll", |config| Config { storage: Storage::Ll, ..config }),
    ("ll, sort off", |config| Config { storage: Storage::Ll, sort: false, ..config }),
    ("dll", |config| Config { storage: Storage::Dll, ..config }),
    ("dll, 7 units per dispatch", |config| Config { storage: Storage::Dll, work_budget: Some(7), ..config }),
    ("llb", |config| Config { storage: Storage::Llb, ..config }),
    ("llb, inline, address", |config| Config {
        storage: Storage::Llb,
        inline: true,
        addressing: Addressing::Address,
        ..config
    }),
    ("llb, 12 buckets", |config| Config { storage: Storage::Llb, buckets: 12, ..config }),
    ("dllb, inline", |config| Config { inline: true, ..config }),
    ("sb", |config| Config { storage: Storage::Sb, ..config }),
    ("sb, inline", |config| Config { storage: Storage::Sb, inline: true, ..config }),
    ("sb, sort off", |config| Config { storage: Storage::Sb, sort: false, ..config }),
    ("sb, capacity for nothing at first", |config| Config {
        storage: Storage::Sb,
        fragments: Some(0),
        ..config
    }),
    ("paged", |config| Config { storage: Storage::Paged, ..config }),
    ("paged, 2 per page, sort off", |config| Config {
        storage: Storage::Paged,
        page: 2,
        sort: false,
        ..config
    }),
    ("address", |config| Config { addressing: Addressing::Address, ..config }),
    ("address, 7 units per dispatch", |config| Config {
        addressing: Addressing::Address,
        work_budget: Some(7),
        ..config
    }),
    ("2 units per dispatch", |config| Config { work_budget: Some(2), ..config }),
    ("7 units per dispatch", |config| Config { work_budget: Some(7), ..config }),
    ("64 units per dispatch", |config| Config { work_budget: Some(64), ..config }),
    ("capacity for nothing at first", |config| Config { fragments: Some(0), ..config }),
    ("capacity for one fragment at first", |config| Config { fragments: Some(1), ..config }),
    ("counters", |config| Config { counters: Counters::Sums, ..config }),
];

/// Words of a hit that may not change. With interval acceptance a and b are the fragment's place in the pool,
/// which is the order in which threads came.
fn key(config: &Config, hit: &Hit) -> [u32; 4] {
    let [a, b] = if config.accept.needs_triangles() { [hit.a.to_bits(), hit.b.to_bits()] } else { [0; 2] };
    [hit.t.to_bits(), hit.primitive, a, b]
}

struct Answers {
    closest: Vec<[u32; 4]>,
    occluded: Vec<bool>,
}

fn answers(bench: &Bench, config: Config, triangles: &[Triangle], rays: &[Ray]) -> Answers {
    let geometry = bench.geometry(triangles);
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    build_until_complete(bench.device(), &mut structure, EYE, Timing::None).expect("the build completes");
    let (hits, counters) = trace_in_rounds(bench, &structure, rays, TraceMode::Closest, rounds(&config));
    assert_eq!((counters.unfinished, counters.not_ready), (0, 0), "{config:?}");
    assert_eq!(counters.cells > 0, config.counters != Counters::Off);
    let (occluders, counters) =
        trace_in_rounds(bench, &structure, rays, TraceMode::Occluded, rounds(&config));
    assert_eq!((counters.unfinished, counters.not_ready), (0, 0), "{config:?}");
    assert_eq!(structure.status(0).expect("the header is readable").corrupted, 0);
    Answers {
        closest: hits.iter().map(|hit| key(&config, hit)).collect(),
        occluded: occluders.iter().map(Hit::is_hit).collect(),
    }
}

fn rounds(config: &Config) -> u32 {
    config.work_budget.map_or(2, |budget| if budget < 64 { ROUNDS } else { 64 })
}

/// The first ray whose answer differs.
fn first_difference<T: PartialEq>(left: &[T], right: &[T]) -> Option<usize> {
    assert_eq!(left.len(), right.len());
    left.iter().zip(right).position(|(left, right)| left != right)
}

fn no_change_changes_a_hit(base: Config) {
    let bench = Bench::new();
    let (triangles, rays) = (scene(true), rays(600));
    let expected = answers(&bench, base, &triangles, &rays);
    let hit = expected.occluded.iter().filter(|occluded| **occluded).count();
    assert!(hit > 150 && hit < 600, "{hit} of 600 rays hit: too few or too many to compare");
    for (index, (closest, occluded)) in expected.closest.iter().zip(&expected.occluded).enumerate() {
        assert_eq!(
            closest[1] != rasray_ads::PRIMITIVE_NONE,
            *occluded,
            "ray {index}: closest against occluded"
        );
    }
    // The published march reads the same lists.
    let quick = if base.march == March::Exact { IN_COMPANY } else { IN_COMPANY / 2 };
    for (name, change) in first(CHANGES, quick) {
        let config = change(base);
        let found = answers(&bench, config, &triangles, &rays);
        if let Some(ray) = first_difference(&expected.closest, &found.closest) {
            panic!(
                "{name}: ray {ray} ({:?}) hits {:x?}, and {:x?} without the change",
                rays[ray], found.closest[ray], expected.closest[ray]
            );
        }
        assert_eq!(first_difference(&expected.occluded, &found.occluded), None, "{name}: occluded");
    }
}

#[test]
fn robust_hits_do_not_depend_on_speed_options() {
    no_change_changes_a_hit(robust());
}

/// Storages and what they skip must not matter to the fragment's slopes either.
#[test]
fn sloped_hits_do_not_depend_on_the_storage() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(true), rays(600));
    let base = Config { accept: Accept::Slope, march: March::Dda, ..robust() };
    let expected = answers(&bench, base, &triangles, &rays);
    let changes = [
        Config { storage: Storage::Ll, ..base },
        Config { storage: Storage::Sb, skip: false, ..base },
        Config { storage: Storage::Paged, sort: false, buckets: 1, ..base },
        Config { skip: false, ..base },
        Config { sort: false, buckets: 1, ..base },
    ];
    let storages = Storage::ALL.map(|storage| Config { storage, ..base });
    for &config in first(&changes, 3).iter().chain(first(&storages, 0)) {
        let found = answers(&bench, config, &triangles, &rays);
        assert_eq!(first_difference(&expected.closest, &found.closest), None, "{config:?}");
        assert_eq!(first_difference(&expected.occluded, &found.occluded), None, "{config:?}");
    }
}

/// With enough samples the march takes one step per cell; it visits fewer cells than a ray crosses.
#[test]
fn a_dda_is_a_march_of_enough_samples() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(false), rays(600));
    let march = |march, samples| Config { march, samples, ..sampled() };
    let dda = answers(&bench, march(March::Dda, 1), &triangles, &rays);
    let enough = answers(&bench, march(March::Samples, 65_535), &triangles, &rays);
    assert_eq!(first_difference(&dda.closest, &enough.closest), None);
    let few = answers(&bench, march(March::Samples, 5), &triangles, &rays);
    assert!(first_difference(&dda.closest, &few.closest).is_some());
    let cells = |march| {
        let geometry = bench.geometry(&triangles);
        let config = Config { march, counters: Counters::Sums, ..sampled() };
        let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("valid options");
        build_until_complete(bench.device(), &mut structure, EYE, Timing::None).expect("it completes");
        trace_in_rounds(&bench, &structure, &rays, TraceMode::Closest, 2).1.cells
    };
    let (sampled, exact) = (cells(March::Dda), cells(March::Exact));
    assert!(sampled > 0 && sampled < exact, "{sampled} of {exact} cells");
}

/// Skips leave out cells that hold nothing at a ray's depths, and no others: the searched cells and the
/// intervals of the ray in them are the same, whatever fragments represent.
#[test]
fn skips_change_no_hit() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(true), rays(if is_full() { 40_000 } else { 600 }));
    let storage = |storage, resolution| Config { storage, resolution, ..robust() };
    let slope = Config { accept: Accept::Slope, ..storage(Storage::Paged, 128) };
    let mut configs = vec![robust(), Config { work_budget: Some(7), ..storage(Storage::Sb, 37) }];
    if is_full() {
        configs.push(Config { skip: false, accept: Accept::Interval, ..storage(Storage::Ll, 64) });
        configs.push(Config { addressing: Addressing::Address, ..storage(Storage::Dll, 61) });
        configs.push(slope);
    }
    for config in configs {
        let expected = answers(&bench, config, &triangles, &rays);
        let found = answers(&bench, Config { march: March::Pyramid, ..config }, &triangles, &rays);
        if let Some(ray) = first_difference(&expected.closest, &found.closest) {
            let (found, expected) = (found.closest[ray], expected.closest[ray]);
            panic!("{config:?}: {:?} hits {found:x?} with skips, {expected:x?} without", rays[ray]);
        }
        assert_eq!(first_difference(&expected.occluded, &found.occluded), None, "{config:?}");
    }
}

/// Fewer cells are visited by the blocks' depths, and where those are spoilt hits are lost.
#[test]
fn skips_follow_the_depths_of_blocks() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(false), rays(600));
    let base = Config { resolution: 64, counters: Counters::Sums, ..robust() };
    let traced = |structure: &ABuffer| trace_in_rounds(&bench, structure, &rays, TraceMode::Closest, 2);
    let built = |march| {
        let geometry = bench.geometry(&triangles);
        let mut structure =
            ABuffer::new(bench.device(), Config { march, ..base }, &geometry, None).expect("valid options");
        build_until_complete(bench.device(), &mut structure, EYE, Timing::None).expect("it completes");
        structure
    };
    let (hits, exact) = traced(&built(March::Exact));
    let structure = built(March::Pyramid);
    let (same, skipping) = traced(&structure);
    assert_eq!(hits, same);
    assert_eq!((exact.entries, exact.tests), (skipping.entries, skipping.tests));
    assert!(5 * skipping.cells < 3 * exact.cells, "{} of {} cells", skipping.cells, exact.cells);
    let mut contents = structure.download(bench.device()).expect("the device works");
    let cells = 4 * cell_count(structure.config()) as usize;
    contents.bounds[cells..].fill(0);
    // SAFETY: the header's capacities and addresses are those that were downloaded, and nothing was resized
    // since.
    unsafe { structure.upload(bench.device(), &contents) }.expect("it fits");
    assert!(traced(&structure).0.iter().all(|hit| !hit.is_hit()));
}

#[test]
fn sampled_hits_do_not_depend_on_speed_options() {
    no_change_changes_a_hit(sampled());
}

fn order_of_triangles_does_not_matter(base: Config) {
    let bench = Bench::new();
    let (triangles, rays) = (scene(false), rays(600));
    let expected = answers(&bench, base, &triangles, &rays);
    let mut random = Random::new(5);
    for _ in 0..2 {
        // Place k of the new list holds triangle order[k] of the old one.
        let order = random.shuffled(triangles.len());
        let shuffled: Vec<Triangle> = order.iter().map(|&index| triangles[index]).collect();
        let mut found = answers(&bench, base, &shuffled, &rays);
        for answer in &mut found.closest {
            answer[1] = order.get(answer[1] as usize).map_or(answer[1], |&index| index as u32);
        }
        if let Some(ray) = first_difference(&expected.closest, &found.closest) {
            panic!(
                "ray {ray} ({:?}) hits {:x?}, and {:x?} in the order given",
                rays[ray], found.closest[ray], expected.closest[ray]
            );
        }
        assert_eq!(first_difference(&expected.occluded, &found.occluded), None);
    }
}

#[test]
fn robust_hits_do_not_depend_on_the_order_of_triangles() {
    order_of_triangles_does_not_matter(robust());
}

#[test]
fn sampled_hits_do_not_depend_on_the_order_of_triangles() {
    order_of_triangles_does_not_matter(sampled());
}

/// Shows that the comparison would notice: these options do change hits.
#[test]
fn options_that_may_change_hits_do() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(false), rays(600));
    let expected = answers(&bench, robust(), &triangles, &rays);
    let changes: [(&str, Change); 4] = [
        ("resolution", |config| Config { resolution: 12, ..config }),
        ("acceptance", |config| Config { accept: Accept::Interval, ..config }),
        ("slopes", |config| Config { accept: Accept::Slope, ..config }),
        ("march", |config| Config { march: March::Samples, samples: 5, ..config }),
    ];
    for (name, change) in changes {
        let found = answers(&bench, change(robust()), &triangles, &rays);
        assert!(first_difference(&expected.closest, &found.closest).is_some(), "{name} changes nothing");
    }
}

#[test]
fn a_budget_without_progress_is_refused() {
    let bench = Bench::new();
    let geometry = bench.geometry(&scene(false));
    for budget in [0, 1] {
        let config = Config { work_budget: Some(budget), ..robust() };
        let error = ABuffer::new(bench.device(), config, &geometry, None).map(drop).expect_err("no progress");
        assert!(error.to_string().contains("work budget"), "{error}");
    }
}

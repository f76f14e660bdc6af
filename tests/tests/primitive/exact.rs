//! Lists of triangles, per tile and in bricks, against brute force, bit for bit: at every size of cells, from
//! every eye and origin, with every budget; and lists that cover too little are noticed.

use rasray_ads::{BruteForce, Counters, Hit, Ray, Structure, TraceMode};
use rasray_bricks::{Bricks, Config as BricksConfig, Views};
use rasray_gpu::{Feature, Timing};
use rasray_primitive::{
    Accept, Addressing, Builder, Config, Coverage, Depths, March, PrimitiveLists, PyramidStart, Stop, Storage,
};
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::rays::towards;
use rasray_tests::shapes::{Triangle, all_sizes, closed_box, sphere};
use rasray_tests::tier::is_full;
use rasray_tracer::build_until_complete;

const EYES: [[f32; 3]; 3] = [[0.0; 3], [0.125, -0.25, 0.375], [-3.0, 2.0, 1.5]];

/// Structure under test.
#[derive(Clone, Copy, Debug)]
enum Made {
    Lists(Config),
    Bricks(BricksConfig),
}

impl Made {
    /// Built from an eye.
    fn built(self, bench: &Bench, triangles: &[Triangle], eye: [f32; 3]) -> Box<dyn Structure> {
        let (device, geometry) = (bench.device(), bench.geometry(triangles));
        let mut structure: Box<dyn Structure> = match self {
            Self::Lists(config) => {
                Box::new(PrimitiveLists::new(device, config, &geometry, None).expect("valid options"))
            }
            Self::Bricks(config) => {
                Box::new(Bricks::new(device, config, &geometry, None).expect("valid options"))
            }
        };
        build_until_complete(device, structure.as_mut(), eye, Timing::None).expect("the build completes");
        structure
    }

    /// The structure with options that change no hit: the other builder, pools by address, no blocks of
    /// tiles.
    fn otherwise(self) -> Self {
        let other = |builder| match builder {
            Builder::Raster => Builder::Binning,
            Builder::Binning => Builder::Raster,
        };
        let addressing = Addressing::Address;
        match self {
            Self::Lists(config) => {
                let builder = other(config.builder);
                Self::Lists(Config { addressing, builder, pyramid: false, ..config })
            }
            Self::Bricks(config) => {
                Self::Bricks(BricksConfig { addressing, builder: other(config.builder), ..config })
            }
        }
    }

    fn with_budget(self, units: u32) -> Self {
        match self {
            Self::Lists(config) => Self::Lists(Config { work_budget: Some(units), ..config }),
            Self::Bricks(config) => Self::Bricks(BricksConfig { work_budget: Some(units), ..config }),
        }
    }

    /// True if triangles around the eye are in a list of their own.
    fn has_near_region_list(self) -> bool {
        !matches!(self, Self::Bricks(BricksConfig { views: Views::Axes, .. }))
    }
}

/// Lists in each storage, with two pixels to a tile, and bricks of both views.
fn all(resolution: u32) -> [Made; 4] {
    let lists = |storage| Made::Lists(Config { storage, ..Config::robust(resolution) });
    let bricks =
        |views| Made::Bricks(BricksConfig { grid: Some(resolution / 2), ..BricksConfig::new(views) });
    [lists(Storage::Contiguous), lists(Storage::Linked), bricks(Views::Cube), bricks(Views::Axes)]
}

fn lists(bench: &Bench, config: Config, triangles: &[Triangle], eye: [f32; 3]) -> Box<dyn Structure> {
    Made::Lists(config).built(bench, triangles, eye)
}

fn brute_force(bench: &Bench, triangles: &[Triangle], rays: &[Ray]) -> Vec<Hit> {
    let geometry = bench.geometry(triangles);
    let structure = BruteForce::new(bench.device(), &geometry, None, false).expect("pipelines can be made");
    bench.trace(&structure, rays).hits
}

/// Rays whose hits differ in any bit.
fn differences(found: &[Hit], expected: &[Hit]) -> Vec<usize> {
    assert_eq!(found.len(), expected.len());
    (0..found.len()).filter(|&ray| bits(&found[ray]) != bits(&expected[ray])).collect()
}

fn assert_exact(what: &str, bench: &Bench, structure: &dyn Structure, rays: &[Ray], expected: &[Hit]) {
    let hits = bench.trace(structure, rays).hits;
    if let [first, ..] = differences(&hits, expected)[..] {
        let (ray, hit, expected) = (rays[first], hits[first], expected[first]);
        panic!("{what}: {ray:?}: {hit:?}, brute force finds {expected:?}");
    }
    for (ray, occluded) in bench.occluded(structure, rays).into_iter().enumerate() {
        assert_eq!(occluded, expected[ray].is_hit(), "{what}: {:?}", rays[ray]);
    }
    assert_eq!(structure.status(0).expect("the header is readable").corrupted, 0, "{what}");
}

#[test]
fn hits_are_those_of_brute_force() {
    let bench = Bench::new();
    let triangles = all_sizes();
    let (rounds, count) = if is_full() { (100, 100_000) } else { (1, 20_000) };
    for round in 0..rounds {
        let rays = Random::new(round).rays(count, -9.0, 9.0);
        let expected = brute_force(&bench, &triangles, &rays);
        let hit = expected.iter().filter(|hit| hit.is_hit()).count();
        assert!(hit > rays.len() * 9 / 10, "{hit} rays hit");
        let [contiguous, _, cube, axes] = all(128);
        for made in [contiguous, cube, axes] {
            let structure = made.built(&bench, &triangles, EYES[round as usize % 3]);
            assert_exact(&format!("{made:?}"), &bench, structure.as_ref(), &rays, &expected);
        }
    }
}

#[test]
fn no_size_changes_a_hit() {
    let bench = Bench::new();
    let (triangles, rays) = (all_sizes(), Random::new(3).rays(4000, -9.0, 9.0));
    let expected = brute_force(&bench, &triangles, &rays);
    let sizes = [
        (1, 1, 1),
        (2, 1, 64),
        (3, 2, 4),
        (7, 1, 5),
        (33, 4, 2),
        (64, 1, 1),
        (100, 8, 16),
        (256, 2, 32),
        (300, 1, 8),
    ];
    // Two of five in the quick tier: every value of every option occurs.
    let is_due = |index: usize| is_full() || index % 5 < 2;
    for (index, (resolution, tile, buckets)) in
        sizes.into_iter().enumerate().filter(|(index, _)| is_due(*index))
    {
        let storage = if index % 2 == 0 { Storage::Linked } else { Storage::Contiguous };
        let builder = if index % 4 < 2 { Builder::Binning } else { Builder::Raster };
        let (skip, pyramid) = (index % 3 != 0, index % 2 == 0);
        let config = Config { tile, buckets, storage, skip, builder, pyramid, ..Config::robust(resolution) };
        let structure = lists(&bench, config, &triangles, EYES[index % 3]);
        assert_exact(&format!("{config:?}"), &bench, structure.as_ref(), &rays, &expected);
    }
    let faces = [
        (1, None),
        (4, Some(1)),
        (5, Some(30)),
        (9, Some(64)),
        (64, Some(7)),
        (50, Some(200)),
        (128, Some(1024)),
        (300, None),
    ];
    let faces = faces.map(|(grid, slices)| (Views::Cube, grid, slices));
    let axes = [1, 5, 16, 77, 256].map(|grid| (Views::Axes, grid, None));
    for (index, (views, grid, slices)) in
        faces.into_iter().chain(axes).enumerate().filter(|(index, _)| is_due(*index))
    {
        let (skip, corners) = (index % 3 != 0, index % 2 == 0);
        let builder = if index % 4 < 2 { Builder::Raster } else { Builder::Binning };
        let own = BricksConfig::new(views);
        let config = BricksConfig { grid: Some(grid), slices, skip, corners, builder, ..own };
        let structure = Made::Bricks(config).built(&bench, &triangles, EYES[index % 3]);
        assert_exact(&format!("{config:?}"), &bench, structure.as_ref(), &rays, &expected);
    }
    for made in all(64).map(Made::otherwise) {
        let structure = made.built(&bench, &triangles, EYES[1]);
        assert_exact(&format!("{made:?}"), &bench, structure.as_ref(), &rays, &expected);
    }
}

/// Triangles that cross each other and triangles that are seen almost edge-on, in tiles and buckets so wide
/// that many share one.
fn crossing() -> Vec<Triangle> {
    let mut random = Random::new(29);
    let mut triangles: Vec<Triangle> = (0..300)
        .map(|_| {
            let at = random.point(-8.0, 8.0);
            let size = random.between(0.2, 3.0);
            std::array::from_fn(|_| {
                let away = random.point(-size, size);
                std::array::from_fn(|axis| at[axis] + away[axis])
            })
        })
        .collect();
    for _ in 0..400 {
        // Seen almost edge-on from the middle.
        let (far, nearby) = (random.point(-9.0, 9.0), random.point(-2.0, 2.0));
        let near = random.point(-0.1, 0.1);
        triangles.push([
            far,
            std::array::from_fn(|axis| 0.2 * far[axis] + near[axis]),
            std::array::from_fn(|axis| 0.6 * far[axis] + nearby[axis]),
        ]);
    }
    triangles.extend(closed_box([-10.0; 3], [10.0; 3]));
    triangles
}

/// Each rule of the paper loses hits by itself, and what is found instead lies behind: the comparison
/// notices. The rule that a hit must lie in its tile alone loses those that rounding moves: one in many
/// thousands.
#[test]
fn every_published_rule_loses_hits() {
    let bench = Bench::new();
    let (triangles, rays) = (crossing(), Random::new(5).rays(20_000, -9.0, 9.0));
    let expected = brute_force(&bench, &triangles, &rays);
    let lists_of = |resolution, buckets| {
        let storage = Storage::Contiguous;
        Config { tile: 1, buckets, storage, pyramid: false, ..Config::robust(resolution) }
    };
    let (coarse, fine) = (lists_of(1, 4), lists_of(64, 8));
    for (rule, config, least) in [
        ("coverage", Config { coverage: Coverage::Hardware, builder: Builder::Raster, ..fine }, 100),
        ("stop", Config { stop: Stop::Bucket, ..coarse }, 10),
        ("depths", Config { depths: Depths::Corners, ..fine }, 10),
        ("march", Config { march: March::Jump, ..fine }, 10),
        ("accept and march", Config { accept: Accept::Tile, march: March::Jump, ..fine }, 100),
        ("all", Config { tile: 1, buckets: 8, ..Config::published(64) }, 100),
    ] {
        assert!(!config.is_exact(), "{rule}");
        let structure = lists(&bench, config, &triangles, EYES[0]);
        let hits = bench.trace(structure.as_ref(), &rays).hits;
        let lost = differences(&hits, &expected);
        assert!(lost.len() > least, "{rule}: {} of {} hits differ", lost.len(), rays.len());
        println!("{rule}: {} of {} hits differ", lost.len(), rays.len());
        assert!(lost.iter().all(|&ray| !hits[ray].is_hit() || hits[ray].t >= expected[ray].t), "{rule}");
    }
    let accept = Config { accept: Accept::Tile, ..fine };
    let structure = lists(&bench, accept, &triangles, EYES[0]);
    let lost = differences(&bench.trace(structure.as_ref(), &rays).hits, &expected).len();
    println!("accept: {lost} of {} hits differ", rays.len());
    // Rounding alone moves a hit to another tile. The rule has an effect together with the jump, where it
    // refuses hits that a skipped tile would have had.
    assert!(!accept.is_exact() && lost < rays.len() / 1000, "{lost} of {} hits differ", rays.len());
    let jumping = Config { march: March::Jump, ..fine };
    let refusing = Config { accept: Accept::Tile, ..jumping };
    let [jumping, refusing] = [jumping, refusing].map(|config| {
        let structure = lists(&bench, config, &triangles, EYES[0]);
        differences(&bench.trace(structure.as_ref(), &rays).hits, &expected).len()
    });
    assert!(refusing > 10 * jumping, "{refusing} hits differ with the rule, {jumping} without");
}

/// Conservative rasterization by the device lists a triangle in no tile that the shared function leaves out,
/// and in most that it does not; what is lost lies in front. Without the feature it is refused.
#[test]
fn what_the_extension_touches_is_part_of_conservative_lists() {
    let bench = Bench::new();
    let (triangles, rays) = (crossing(), Random::new(5).rays(20_000, -9.0, 9.0));
    let conservative = Config { tile: 1, buckets: 1, ..Config::robust(64) };
    let extension =
        Config { coverage: Coverage::ConservativeExtension, builder: Builder::Raster, ..conservative };
    assert!(conservative.is_exact() && !extension.is_exact());
    if !bench.device().has(Feature::ConservativeRasterization) {
        let made = PrimitiveLists::new(bench.device(), extension, &bench.geometry(&triangles), None);
        let error = made.map(drop).expect_err("the device lacks it").to_string();
        assert!(error.contains("VK_EXT_conservative_rasterization"), "{error}");
        println!("skipped: the device has no VK_EXT_conservative_rasterization");
        return;
    }
    let expected = brute_force(&bench, &triangles, &rays);
    let stored = |structure: &dyn Structure| {
        let stored = structure.report().expect("the header is readable").stored;
        stored.expect("entries are counted")
    };
    let all = lists(&bench, conservative, &triangles, EYES[0]);
    let touched = lists(&bench, extension, &triangles, EYES[0]);
    let hits = bench.trace(touched.as_ref(), &rays).hits;
    let lost = differences(&hits, &expected);
    let (all, touched) = (stored(all.as_ref()), stored(touched.as_ref()));
    println!("{touched} of {all} entries, {} of {} hits differ", lost.len(), rays.len());
    assert!(touched <= all && touched > all / 10 * 9, "{touched} of {all} entries");
    assert!(lost.len() < rays.len() / 100, "{} of {} hits differ", lost.len(), rays.len());
    assert!(lost.iter().all(|&ray| !hits[ray].is_hit() || hits[ray].t >= expected[ray].t));
}

/// Blocks of tiles are searched from either end of the pyramid for the largest that holds nothing: a ray
/// visits the same tiles, and without blocks more of them.
#[test]
fn the_pyramid_skips_the_same_from_either_end() {
    let bench = Bench::new();
    let (triangles, rays) = (sphere([0.0; 3], 6.0, 24), Random::new(41).rays(4000, -9.0, 9.0));
    let expected = brute_force(&bench, &triangles, &rays);
    let own = Config { counters: Counters::Sums, tile: 1, ..Config::robust(64) };
    let coarsest = Config { pyramid_start: PyramidStart::Coarsest, ..own };
    let [finest, coarsest, none] = [own, coarsest, Config { pyramid: false, ..own }].map(|config| {
        let structure = lists(&bench, config, &triangles, EYES[1]);
        let traced = bench.trace(structure.as_ref(), &rays);
        assert!(differences(&traced.hits, &expected).is_empty(), "{config:?}");
        (traced.counters.cells, traced.counters.tests)
    });
    println!("tiles and tests: {finest:?} from the finest, {coarsest:?} from the coarsest, {none:?} without");
    assert_eq!(finest, coarsest);
    assert!(none.0 > 2 * finest.0, "{none:?} {finest:?}");
}

/// Rays that start far outside of everything, beyond what the cells can bear and below it; and rays from an
/// eye far outside.
#[test]
fn distance_changes_no_hit() {
    let bench = Bench::new();
    let triangles = all_sizes();
    let mut random = Random::new(17);
    for distance in [30.0, 45.0, 1.0e3, 1.0e5] {
        let rays: Vec<Ray> = (0..1000)
            .map(|_| {
                let (target, away) = (random.point(-9.0, 9.0), random.direction());
                let origin = std::array::from_fn(|axis| target[axis] - distance * away[axis]);
                Ray::new(origin, away)
            })
            .collect();
        let expected = brute_force(&bench, &triangles, &rays);
        assert!(expected.iter().all(Hit::is_hit));
        for made in all(64) {
            for eye in [EYES[0], [0.0, distance, 0.0]] {
                let what = format!("rays from {distance} m away, eye at {eye:?}, {made:?}");
                let structure = made.built(&bench, &triangles, eye);
                assert_exact(&what, &bench, structure.as_ref(), &rays, &expected);
            }
        }
    }
}

/// Triangles so close to the eye that their cell is lost in rounding are found all the same.
#[test]
fn triangles_around_the_eye_are_found() {
    let bench = Bench::new();
    for eye in EYES {
        let shifted = |p: [f32; 3]| -> [f32; 3] { std::array::from_fn(|axis| p[axis] + eye[axis]) };
        let mut triangles = all_sizes();
        let mut random = Random::new(8);
        for _ in 0..200 {
            let size = 10.0_f32.powf(random.between(-7.0, -1.0));
            triangles.push(std::array::from_fn(|_| shifted(random.point(-size, size))));
        }
        let rays: Vec<Ray> = (0..2000)
            .map(|index| {
                let target = shifted(random.point(-1.0e-3, 1.0e-3));
                let origin = if index % 2 == 0 { eye } else { random.point(-2.0, 2.0) };
                towards(origin, target)
            })
            .collect();
        let expected = brute_force(&bench, &triangles, &rays);
        assert!(expected.iter().filter(|hit| hit.primitive as usize >= triangles.len() - 200).count() > 200);
        for made in all(64) {
            let structure = made.built(&bench, &triangles, eye);
            let status = structure.status(0).expect("the header is readable");
            let near = status.demand("near").expect("the pool is counted") as usize;
            let right =
                if made.has_near_region_list() { near > 20 && near < triangles.len() / 2 } else { near == 0 };
            assert!(right, "{made:?}: {near} triangles are in the near-region list");
            let what = format!("eye at {eye:?}, {made:?}");
            assert_exact(&what, &bench, structure.as_ref(), &rays, &expected);
        }
    }
}

/// Ranges and exclusions, as brute force keeps them.
#[test]
fn limits_and_exclusion_are_kept() {
    let bench = Bench::new();
    let triangles = all_sizes();
    let mut random = Random::new(21);
    let mut rays = Random::new(22).rays(3000, -9.0, 9.0);
    for (ray, first) in rays.clone().iter().zip(brute_force(&bench, &triangles, &rays)) {
        rays.extend([
            Ray { t_max: first.t, ..*ray },
            Ray { t_max: first.t.next_up(), ..*ray },
            Ray { t_min: first.t, ..*ray },
            Ray { t_min: first.t.next_down(), ..*ray },
            Ray { exclude_primitive: first.primitive, ..*ray },
            Ray { t_min: random.between(0.0, 5.0), t_max: random.between(0.0, 9.0), ..*ray },
            // Not of unit length.
            Ray { direction: ray.direction.map(|x| 1.0e-3 * x), ..*ray },
        ]);
    }
    let expected = brute_force(&bench, &triangles, &rays);
    for made in all(64) {
        let structure = made.built(&bench, &triangles, EYES[1]);
        assert_exact(&format!("limits, {made:?}"), &bench, structure.as_ref(), &rays, &expected);
    }
}

/// A ray may stop after any work unit and go on in the next dispatch.
#[test]
fn no_budget_changes_a_hit() {
    let bench = Bench::new();
    let mut triangles = closed_box([-10.0; 3], [10.0; 3]);
    triangles.extend(sphere([-3.0, 0.5, -2.0], 1.5, 8));
    let mut rays = Random::new(9).rays(300, -9.0, 9.0);
    // Some are tested against every triangle, and some against the near-region list.
    rays.extend((0..20).map(|k| Ray::new([0.0, 50.0, k as f32 / 20.0], [0.0, -1.0, 0.0])));
    let expected = brute_force(&bench, &triangles, &rays);
    for (budget, rounds) in [(1, 4000), (2, 2000), (3, 1500), (64, 100)] {
        for made in all(32).map(|made| made.with_budget(budget)) {
            let structure = made.built(&bench, &triangles, EYES[1]);
            let trace =
                |rounds| trace_in_rounds(&bench, structure.as_ref(), &rays, TraceMode::Closest, rounds);
            let (hits, counters) = trace(rounds);
            assert_eq!((counters.unfinished, counters.not_ready), (0, 0), "{budget} units per dispatch");
            assert_eq!(differences(&hits, &expected), [0; 0], "{made:?}");
            // With too few rounds rays are counted, never given half an answer.
            assert!(trace(2).1.unfinished > 0);
        }
    }
}

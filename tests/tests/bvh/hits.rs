//! Hits of the BVH are those of brute force, bit for bit, whatever its options and however often rays pause.

use rasray_ads::{BruteForce, Counters, Geometry, Hit, Ray, Structure, TraceMode};
use rasray_bvh::{Addressing, Builder, Bvh, Children, Config, Loads, well_formed};
use rasray_gpu::{Feature, Timing};
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::rays::{along_axis, towards};
use rasray_tests::shapes::{Triangle, layers_and_sphere, with_twins};
use rasray_tracer::{BatchTracer, build_until_complete};

const RAYS: usize = 3000;

/// Every builder of trees of its own, with every number of children.
const KINDS: [(Builder, Children); 8] = [
    (Builder::Sah, Children::Two),
    (Builder::Sah, Children::Four),
    (Builder::Lbvh, Children::Two),
    (Builder::Lbvh, Children::Four),
    (Builder::Ploc, Children::Two),
    (Builder::Ploc, Children::Four),
    (Builder::Trbvh, Children::Two),
    (Builder::Trbvh, Children::Four),
];

/// Rays of all kinds: along axes and face diagonals, from corners of triangles, at corners and edges, with
/// ranges and with an excluded triangle.
fn rays(triangles: &[Triangle]) -> Vec<Ray> {
    let mut random = Random::new(23);
    (0..RAYS)
        .map(|index| {
            let origin = random.point(-6.0, 6.0);
            let triangle = triangles[(random.bits() % triangles.len() as u64) as usize];
            let corner = triangle[index % 3];
            match index % 10 {
                0 => Ray::new(if index % 20 == 0 { origin } else { corner }, along_axis(index / 10)),
                1 => Ray { t_max: 2.0, t_min: 0.5, ..Ray::new(origin, random.direction()) },
                2 => towards(origin, corner),
                3 => {
                    let next = triangle[(index + 1) % 3];
                    towards(origin, std::array::from_fn(|axis| 0.5 * corner[axis] + 0.5 * next[axis]))
                }
                4 => Ray::new(corner, random.direction()),
                5 => Ray {
                    exclude_primitive: (random.bits() % triangles.len() as u64) as u32,
                    ..Ray::new(origin, random.direction())
                },
                6 => Ray::new(origin, [1.0, -1.0, 0.0]),
                _ => Ray::new(origin, random.direction()),
            }
        })
        .collect()
}

struct Answers {
    closest: Vec<[u32; 4]>,
    occluded: Vec<bool>,
}

fn traced(bench: &Bench, structure: &mut dyn Structure, rays: &[Ray], rounds: u32) -> Answers {
    build_until_complete(bench.device(), structure, [0.0; 3], Timing::None).expect("the build completes");
    let of = |mode| {
        let (hits, counters) = trace_in_rounds(bench, structure, rays, mode, rounds);
        assert_eq!((counters.unfinished, counters.not_ready), (0, 0));
        hits
    };
    let (closest, occluded) = (of(TraceMode::Closest), of(TraceMode::Occluded));
    assert_eq!(structure.status(0).expect("the header is readable").corrupted, 0);
    Answers {
        closest: closest.iter().map(bits).collect(),
        occluded: occluded.iter().map(Hit::is_hit).collect(),
    }
}

fn reference_answers(bench: &Bench, geometry: &Geometry, rays: &[Ray]) -> Answers {
    let mut reference =
        BruteForce::new(bench.device(), geometry, None, false).expect("pipelines can be made");
    let rounds = reference.rounds();
    traced(bench, &mut reference, rays, rounds)
}

fn of_bvh(bench: &Bench, config: Config, geometry: &Geometry, rays: &[Ray], rounds: Option<u32>) -> Answers {
    let mut bvh = Bvh::new(bench.device(), config, geometry, None).expect("the options are valid");
    let rounds = rounds.unwrap_or_else(|| bvh.rounds());
    traced(bench, &mut bvh, rays, rounds)
}

fn same(expected: &Answers, found: &Answers, rays: &[Ray], what: &str) {
    for (ray, (expected, found)) in expected.closest.iter().zip(&found.closest).enumerate() {
        assert_eq!(expected, found, "{what}: closest hit of ray {ray}, {:?}", rays[ray]);
    }
    for (ray, (expected, found)) in expected.occluded.iter().zip(&found.occluded).enumerate() {
        assert_eq!(expected, found, "{what}: occlusion of ray {ray}, {:?}", rays[ray]);
    }
}

/// Such triangles are not hit, and hide no others of their nodes.
#[test]
fn triangles_with_corners_that_are_no_numbers_hide_nothing() {
    let bench = Bench::new();
    let sound = layers_and_sphere(8);
    let mut triangles = sound.clone();
    for (index, triangle) in triangles.iter_mut().enumerate().filter(|(index, _)| index % 5 == 0) {
        triangle[index % 3][index / 5 % 3] = f32::NAN;
        if index % 4 == 0 {
            *triangle = [[f32::NAN; 3]; 3];
        }
    }
    let (geometry, rays) = (bench.geometry(&triangles), rays(&sound));
    let expected = reference_answers(&bench, &geometry, &rays);
    let hits = expected.occluded.iter().filter(|occluded| **occluded).count();
    assert!((RAYS / 10..RAYS).contains(&hits), "{hits}");
    for (builder, children) in KINDS.into_iter().chain([(Builder::Refit, Children::Four)]) {
        let config = Config { children: Some(children), ..Config::new(builder) };
        let mut bvh = Bvh::new(bench.device(), config, &geometry, None).expect("the options are valid");
        let rounds = bvh.rounds();
        let what = format!("{builder:?}, {children:?} children");
        // The second build may keep the tree of the first.
        for _ in 0..2 {
            same(&expected, &traced(&bench, &mut bvh, &rays, rounds), &rays, &what);
        }
        let contents = bvh.download(bench.device()).expect("the tree can be downloaded");
        well_formed(&contents).unwrap_or_else(|fault| panic!("{what}: {fault}"));
    }
}

/// Every option, and budgets so small that a ray pauses after every node.
fn configurations(builder: Builder) -> Vec<(String, Config, Option<u32>)> {
    let base = Config::new(builder);
    let mut configurations = vec![
        ("defaults".to_owned(), base, None),
        ("counters".to_owned(), Config { counters: Counters::Sums, ..base }, None),
        ("address".to_owned(), Config { addressing: Addressing::Address, ..base }, None),
    ];
    for (budget, rounds) in [(1, 1200), (2, 700), (3, 500), (7, 250), (64, 40)] {
        for addressing in [Addressing::Descriptor, Addressing::Address] {
            let config = Config { work_budget: Some(budget), addressing, ..base };
            configurations.push((
                format!("{budget} units per dispatch, {addressing:?}"),
                config,
                Some(rounds),
            ));
        }
    }
    if matches!(builder, Builder::Sah | Builder::Ploc) {
        for leaf in [1, 2, 8, 16] {
            configurations.push((
                format!("{leaf} triangles per leaf"),
                Config { leaf: Some(leaf), ..base },
                None,
            ));
        }
    }
    for children in [Children::Two, Children::Four] {
        let of_number = Config { children: Some(children), ..base };
        configurations.push((format!("{children:?} children per node"), of_number, None));
        let paused = Config { work_budget: Some(3), addressing: Addressing::Address, ..of_number };
        configurations.push((
            format!("{children:?} children per node, 3 units per dispatch"),
            paused,
            Some(500),
        ));
        for loads in [Loads::Bits32, Loads::Bits64] {
            for addressing in [Addressing::Descriptor, Addressing::Address] {
                let config = Config { loads: Some(loads), addressing, ..of_number };
                let name = format!("{loads:?}, {children:?} children per node, {addressing:?}");
                configurations.push((name, config, None));
            }
        }
    }
    configurations
}

/// The device chooses words of 64 bits only where it is software, and the kernel is that of the choice.
#[test]
fn kernels_read_in_the_words_that_are_asked_for() {
    let bench = Bench::new();
    let device = bench.device();
    let geometry = bench.geometry(&layers_and_sphere(8));
    let has_words = device.has(Feature::Int64);
    let by_default = if has_words && device.is_software() { ".words64" } else { "" };
    let wanted = [(None, by_default), (Some(Loads::Bits32), ""), (Some(Loads::Bits64), ".words64")];
    for (loads, suffix) in wanted.into_iter().filter(|(loads, _)| *loads != Some(Loads::Bits64) || has_words)
    {
        let config = Config { loads, ..Config::new(Builder::Sah) };
        let mut bvh = Bvh::new(device, config, &geometry, None).expect("the options are valid");
        build_until_complete(device, &mut bvh, [0.0; 3], Timing::None).expect("the build completes");
        let tracer = BatchTracer::new(device, 1).expect("a queue fits");
        let ray = Ray::new([0.0; 3], [1.0, 0.0, 0.0]);
        let outcome = tracer.trace(&bvh, &[ray], TraceMode::Closest, Timing::Host).expect("it finishes");
        assert_eq!(outcome.passes[0].label, format!("bvh/trace_closest{suffix}"), "{loads:?}");
    }
    let required = |loads| Bvh::requirements_of(&Config { loads, ..Config::new(Builder::Sah) }).required;
    assert!(required(Some(Loads::Bits64)).contains(&Feature::Int64));
    assert!(
        !required(Some(Loads::Bits32)).contains(&Feature::Int64) && !required(None).contains(&Feature::Int64)
    );
}

fn options_change_no_hit(builder: Builder) {
    let bench = Bench::new();
    let triangles = with_twins(layers_and_sphere(8));
    let (geometry, rays) = (bench.geometry(&triangles), rays(&triangles));
    let expected = reference_answers(&bench, &geometry, &rays);
    let hit = expected.occluded.iter().filter(|occluded| **occluded).count();
    assert!(hit > RAYS / 4 && hit < RAYS, "{hit} of {RAYS} rays hit: too few or too many to compare");
    for (name, config, rounds) in configurations(builder) {
        if config.loads == Some(Loads::Bits64) && !bench.device().has(Feature::Int64) {
            println!("{name}: the device has no 64-bit integers");
            continue;
        }
        let found = of_bvh(&bench, config, &geometry, &rays, rounds);
        same(&expected, &found, &rays, &format!("{builder:?}, {name}"));
    }
}

#[test]
fn by_surface_area_no_option_changes_a_hit() {
    options_change_no_hit(Builder::Sah);
}

#[test]
fn of_clusters_no_option_changes_a_hit() {
    options_change_no_hit(Builder::Ploc);
}

#[test]
fn of_treelets_no_option_changes_a_hit() {
    options_change_no_hit(Builder::Trbvh);
}

#[test]
fn by_morton_codes_no_option_changes_a_hit() {
    options_change_no_hit(Builder::Lbvh);
}

/// A ray that hits thousands of boxes needs more rounds than rays are given at first: it gets them and an
/// answer.
#[test]
fn rays_through_coincident_triangles_are_given_the_rounds_they_need() {
    let bench = Bench::new();
    let triangles = vec![[[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.5, 0.0]]; 2000];
    let rays: Vec<_> = rays(&triangles).into_iter().take(200).collect();
    let geometry = bench.geometry(&triangles);
    let expected = reference_answers(&bench, &geometry, &rays);
    let tracer = BatchTracer::new(bench.device(), rays.len() as u32).expect("a queue fits");
    for (builder, children) in KINDS {
        let config = Config { work_budget: Some(16), children: Some(children), ..Config::new(builder) };
        let mut bvh = Bvh::new(bench.device(), config, &geometry, None).expect("the options are valid");
        build_until_complete(bench.device(), &mut bvh, [0.0; 3], Timing::None).expect("the build completes");
        let first = bvh.rounds();
        let (_, counters) = trace_in_rounds(&bench, &bvh, &rays, TraceMode::Closest, first);
        assert!(counters.unfinished > 0, "{builder:?}, {children:?}: {first} rounds were enough");
        let of = |mode| tracer.trace(&bvh, &rays, mode, Timing::None).expect("every ray is answered").hits;
        let found = Answers {
            closest: of(TraceMode::Closest).iter().map(bits).collect(),
            occluded: of(TraceMode::Occluded).iter().map(Hit::is_hit).collect(),
        };
        same(&expected, &found, &rays, &format!("{builder:?}, {children:?}"));
        assert!(bvh.rounds() > first);
        // It ends: no ray can need more rounds than a ray that hits every box.
        while bvh.allow_more_rounds() {}
        assert!(u64::from(bvh.rounds()) <= 4 * 2000 / 16 + 2);
    }
}

/// Triangles around one place, whose middles halve their way to it along each axis in turn, and a thousand in
/// that place: a tree by Morton codes with 27 levels of one triangle each above ten levels.
fn chain() -> Vec<Triangle> {
    let around = |middle: [f32; 3]| -> Triangle {
        [[-0.2, -0.2, -0.2], [0.2, 0.2, -0.2], [0.2, -0.2, 0.2]]
            .map(|corner: [f32; 3]| std::array::from_fn(|axis| middle[axis] + corner[axis]))
    };
    // Half a cell of the codes above the middle, so that rounding does not decide on which side of it.
    let place = 0.5 + 0.5_f32.powi(11);
    let mut triangles = vec![around([place; 3]); 1024];
    for level in 2..11 {
        let step = 0.5_f32.powi(level);
        for axes in 1..4 {
            triangles
                .push(around(std::array::from_fn(|axis| if axis < axes { place + step } else { place })));
        }
    }
    // They bring the bounds to the unit cube, so that the middle is where codes part.
    triangles.push([[0.0, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]]);
    triangles.push([[1.0, 1.0, 1.0], [1.0, 0.9, 1.0], [1.0, 1.0, 0.9]]);
    triangles
}

/// Triangles of sizes that halve towards the origin, whose boxes all hold a piece of the diagonal and which
/// all lie beside it, and a large one behind them across it: in a tree by surface area of four children per
/// node each level has the next few sizes and all smaller ones. `mirror` turns axes around.
fn scales(mirror: [f32; 3]) -> Vec<Triangle> {
    let mut triangles: Vec<Triangle> = (0..48)
        .map(|level| {
            let size = 0.5_f32.powi(level);
            [[1.0, 1.2, 1.0], [1.9, 2.0, 1.0], [1.0, 2.0, 2.0]].map(|corner| corner.map(|x: f32| x * size))
        })
        .collect();
    triangles.push([[2.5, 2.5, 1.0], [1.0, 4.0, 4.0], [4.0, 1.0, 4.0]]);
    triangles
        .iter()
        .map(|corners| corners.map(|corner| std::array::from_fn(|axis| corner[axis] * mirror[axis])))
        .collect()
}

/// A ray from within all boxes, or towards larger and larger ones, remembers siblings at every level: more
/// than its stack holds.
#[test]
fn rays_that_remember_more_than_their_stack_lose_nothing() {
    let bench = Bench::new();
    let mut random = Random::new(7);
    let within = random.rays(500, 0.4, 0.6);
    let mut scenes = vec![(chain(), within)];
    for mirror in [[1.0; 3], [-1.0; 3]] {
        let mut outwards = || -> Ray {
            let aside = random.point(-0.1, 0.1);
            Ray::new([0.0; 3], std::array::from_fn(|axis| mirror[axis] * (1.0 + aside[axis])))
        };
        scenes.push((scales(mirror), (0..200).map(|_| outwards()).collect()));
    }
    for (triangles, rays) in scenes {
        let geometry = bench.geometry(&triangles);
        let expected = reference_answers(&bench, &geometry, &rays);
        assert!(expected.occluded.iter().any(|occluded| *occluded));
        for (builder, children) in KINDS {
            for budget in [None, Some(50)] {
                let config = Config { work_budget: budget, children: Some(children), ..Config::new(builder) };
                let found = of_bvh(&bench, config, &geometry, &rays, budget.map(|_| 400));
                same(&expected, &found, &rays, &format!("{builder:?}, {children:?}, {budget:?}"));
            }
        }
    }
}

/// Shows that the comparison would notice.
#[test]
fn another_scene_has_other_hits() {
    let bench = Bench::new();
    let triangles = with_twins(layers_and_sphere(8));
    let rays = rays(&triangles);
    let expected = reference_answers(&bench, &bench.geometry(&triangles), &rays);
    let mut moved = triangles;
    for triangle in moved.iter_mut().take(12) {
        triangle[0][1] += 1.0e-3;
    }
    let found = of_bvh(&bench, Config::new(Builder::Sah), &bench.geometry(&moved), &rays, None);
    assert_ne!(expected.closest, found.closest);
    let bvh =
        Bvh::new(bench.device(), Config::new(Builder::Sah), &bench.geometry(&moved), None).expect("valid");
    let (_, counters) = trace_in_rounds(&bench, &bvh, &rays, TraceMode::Closest, 2);
    assert_eq!(counters.not_ready as usize, rays.len(), "a tree that was not built answers nothing");
}

//! Every tree that is built is downloaded and checked node by node.

use rasray_ads::{Check, Structure, TraceMode};
use rasray_bvh::{Addressing, Builder, Bvh, Children, Config, Contents, Fault, Shape, plan, well_formed};
use rasray_experiment::Placed;
use rasray_gpu::Timing;
use rasray_hard_cases as hard_cases;
use rasray_hard_cases::Scale;
use rasray_shaders_glsl::constants::bvh::{BVH_LEAF, BVH_NONE};
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, closed_box, sphere};
use rasray_tests::tier::is_full;
use rasray_tracer::build_until_complete;

/// Triangles of a hard case up to which every run builds it.
const LARGEST: usize = 5_000;

/// Bits of a code and of a place, of which each level of a tree by Morton codes uses one at least.
const LBVH_LEVELS: usize = 62;

/// By how much rounding of areas may raise the cost of a tree that is restructured where it falls.
const ROUNDING: f64 = 1.0e-5;

pub(crate) fn scattered(count: usize, seed: u64, size: f32) -> Vec<Triangle> {
    let mut random = Random::new(seed);
    (0..count)
        .map(|_| {
            let center = random.point(-5.0, 5.0);
            random.triangle(center, size)
        })
        .collect()
}

fn tree(bench: &Bench, config: Config) -> Bvh {
    Bvh::new(bench.device(), config, &bench.geometry(&[]), None).expect("the options are valid")
}

pub(crate) fn build(bench: &Bench, config: Config, triangles: &[Triangle]) -> Contents {
    rebuild(bench, &mut tree(bench, config), triangles)
}

/// Builds over other triangles.
fn rebuild(bench: &Bench, bvh: &mut Bvh, triangles: &[Triangle]) -> Contents {
    bvh.set_geometry(bench.device(), &bench.geometry(triangles)).expect("the pools fit");
    build_until_complete(bench.device(), bvh, [0.0; 3], Timing::None).expect("the build completes");
    let contents = bvh.download(bench.device()).expect("the tree can be downloaded");
    let report = bvh.report().expect("the header is readable");
    let slack = report.slack();
    assert_eq!(
        report.bytes() - slack,
        report.formula_bytes,
        "{:?}, {} triangles",
        bvh.config(),
        triangles.len()
    );
    contents
}

/// Checks the tree, and that its records are the triangles, bit for bit.
pub(crate) fn checked(contents: &Contents, triangles: &[Triangle], what: &str) -> Shape {
    let shape = well_formed(contents).unwrap_or_else(|fault| panic!("{what}: {fault}"));
    assert_eq!(contents.records.len(), triangles.len(), "{what}");
    for record in &contents.records {
        assert_eq!(record.corners(), triangles[record.primitive as usize], "{what}");
    }
    assert_eq!(contents.header.corrupted, 0);
    shape
}

/// Every builder with every number of children that it can make.
fn kinds() -> impl Iterator<Item = Config> {
    let builders =
        [Builder::Sah, Builder::Lbvh, Builder::Ploc, Builder::Trbvh, Builder::Refit].map(Config::new);
    let kinds = builders.into_iter().flat_map(|config| [of_two(config), of_four(config)]);
    kinds.filter(|config| config.builder != Builder::Refit || config.made_children() == Children::Four)
}

/// `config` with two children per node.
pub(crate) fn of_two(config: Config) -> Config {
    Config { children: Some(Children::Two), ..config }
}

/// `config` with four children per node.
fn of_four(config: Config) -> Config {
    Config { children: Some(Children::Four), ..config }
}

/// Only a node over leaves has fewer children than four.
fn are_full(contents: &Contents) -> bool {
    contents.nodes_of_four.iter().all(|node| {
        let children: Vec<_> = node.children().collect();
        children.len() == 4 || children.iter().all(|(_, child, _)| child & BVH_LEAF != 0)
    })
}

fn all_trees_of(config: Config) {
    let bench = Bench::new();
    let twins = vec![[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]; 700];
    let points = vec![[[0.25; 3]; 3]; 65];
    // In a row, each four times as large as the one before: the nearest of each is the one before, so that of
    // clusters only the first two merge in a round.
    let row = (0..60).map(|i| {
        let (e, x) = (2.0_f32.powi(2 * i - 60), 2.0_f32.powi(2 * i - 58));
        [[x, 0.0, 0.0], [x + e, e, 0.0], [x, 0.0, e]]
    });
    let mut room = sphere([0.5, 0.5, 0.5], 0.25, 20);
    room.extend(closed_box([-3.0; 3], [3.0; 3]));
    let mut scenes = vec![
        ("nothing".to_owned(), Vec::new()),
        ("the same triangle 700 times".to_owned(), twins),
        ("points".to_owned(), points),
        ("each larger than the one before".to_owned(), row.collect()),
        ("a sphere in a room".to_owned(), room),
        ("20,000 triangles".to_owned(), scattered(20_000, 3, 0.1)),
    ];
    for count in [1, 2, 3, 4, 5, 7, 8, 9, 63, 64, 65, 255, 256, 257, 1000] {
        scenes.push((format!("{count} triangles"), scattered(count, count as u64, 1.0)));
    }
    for id in hard_cases::ids() {
        let case = hard_cases::case(id, Scale::QUICK).expect("the id is in the catalogue");
        let kept: Vec<Triangle> = Placed::new(&case.triangles).triangles(&case.triangles);
        if is_full() || kept.len() <= LARGEST {
            scenes.push((id.to_owned(), kept));
        }
    }
    let mut by_descriptor = tree(&bench, config);
    let mut by_address = tree(&bench, Config { addressing: Addressing::Address, ..config });
    // The tree that it is made of: that of two children per node, or that by codes, whose treelets are
    // restructured.
    let made_of = match (config.made_children(), config.builder) {
        (Children::Four, _) => Some(of_two(config)),
        (Children::Two, Builder::Trbvh) => Some(of_two(Config::new(Builder::Lbvh))),
        (Children::Two, _) => None,
    };
    let mut made_of = made_of.map(|config| tree(&bench, config));
    for (index, (name, triangles)) in scenes.iter().enumerate() {
        let mut trees = vec![&mut by_descriptor];
        // Every scene in the full tier, every third otherwise: modules differ only in how pools are reached.
        if is_full() || index % 3 == 0 {
            trees.push(&mut by_address);
        }
        for bvh in trees {
            let contents = rebuild(&bench, bvh, triangles);
            let shape = checked(&contents, triangles, name);
            assert!(are_full(&contents), "{name}");
            if config.made_leaf() == 1 {
                assert_eq!(shape.leaves, triangles.len(), "{name}");
            }
            if config.builder == Builder::Lbvh {
                assert!(shape.levels <= LBVH_LEVELS, "{name}: {} levels", shape.levels);
            }
            if let Some(made_of) = &mut made_of {
                let before = checked(&rebuild(&bench, made_of, triangles), triangles, name);
                if made_of.config().made_leaf() == config.made_leaf() {
                    assert_eq!(shape.leaves, before.leaves, "{name}");
                }
                let is_lower = shape.cost <= before.cost * (1.0 + ROUNDING);
                assert!(is_lower, "{name}: {} and {}", shape.cost, before.cost);
            }
        }
    }
}

#[test]
fn trees_by_surface_area_are_sound() {
    all_trees_of(Config::new(Builder::Sah));
}

#[test]
fn trees_by_surface_area_of_two_children_per_node_are_sound() {
    all_trees_of(of_two(Config::new(Builder::Sah)));
}

#[test]
fn trees_by_morton_codes_are_sound() {
    all_trees_of(Config::new(Builder::Lbvh));
}

#[test]
fn trees_by_morton_codes_of_four_children_per_node_are_sound() {
    all_trees_of(of_four(Config::new(Builder::Lbvh)));
}

#[test]
fn trees_of_clusters_are_sound() {
    all_trees_of(Config::new(Builder::Ploc));
}

#[test]
fn trees_of_clusters_of_two_children_per_node_are_sound() {
    all_trees_of(of_two(Config::new(Builder::Ploc)));
}

#[test]
fn trees_of_treelets_are_sound() {
    all_trees_of(Config::new(Builder::Trbvh));
}

#[test]
fn trees_of_treelets_of_two_children_per_node_are_sound_and_cost_no_more_than_those_by_codes() {
    all_trees_of(of_two(Config::new(Builder::Trbvh)));
}

#[test]
fn a_tree_is_the_same_every_time() {
    let bench = Bench::new();
    let triangles = scattered(3000, 8, 0.2);
    for config in kinds() {
        let (first, second) = (build(&bench, config, &triangles), build(&bench, config, &triangles));
        assert!(first.records == second.records, "{config:?}");
        let known =
            |contents: &Contents| contents.nodes.iter().map(|n| (n.children(), n.parent)).collect::<Vec<_>>();
        assert!(known(&first) == known(&second), "{config:?}");
        assert!(first.nodes_of_four == second.nodes_of_four, "{config:?}");
    }
}

#[test]
fn surface_area_gives_cheaper_trees_and_leaves_of_the_size_asked_for() {
    let bench = Bench::new();
    // Fine and coarse triangles side by side: Morton codes do not see sizes.
    let mut triangles = sphere([1.5, 0.5, 0.5], 0.25, 30);
    triangles.extend(closed_box([-3.0; 3], [3.0; 3]));
    triangles.extend(scattered(300, 9, 1.0));
    let shape =
        |config| checked(&build(&bench, config, &triangles), &triangles, "a sphere among large triangles");
    let (sah, lbvh) = (shape(Config::new(Builder::Sah)), shape(Config::new(Builder::Lbvh)));
    assert!(sah.cost < lbvh.cost, "{sah:?} {lbvh:?}");
    assert!(sah.leaves < triangles.len());
    let single = shape(Config { leaf: Some(1), ..Config::new(Builder::Sah) });
    assert_eq!(single.leaves, triangles.len());
}

/// Shows that each check can fail.
#[test]
fn damaged_trees_are_noticed() {
    let bench = Bench::new();
    let triangles = scattered(300, 10, 0.2);
    for config in kinds().filter(|config| config.made_children() == Children::Two) {
        let sound = build(&bench, config, &triangles);
        let damaged = |damage: fn(&mut Contents)| {
            let mut contents = sound.clone();
            damage(&mut contents);
            well_formed(&contents).expect_err("the damage is noticed")
        };
        let fault = damaged(|c| c.nodes[1].lower_0[2] = c.nodes[1].lower_0[2].next_up());
        assert!(matches!(fault, Fault::Bounds { .. }), "{fault}");
        let fault = damaged(|c| c.nodes[0].upper_1[0] += 1.0);
        assert!(matches!(fault, Fault::Bounds { link: 1, .. }), "{fault}");
        let fault = damaged(|c| c.nodes[2].parent ^= 1);
        assert!(matches!(fault, Fault::Parent { node: 2, .. }), "{fault}");
        let fault = damaged(|c| c.nodes[0].child_0 = c.nodes.len() as u32);
        assert!(matches!(fault, Fault::Dangling { .. }), "{fault}");
        let fault = damaged(|c| c.records[5] = c.records[6]);
        assert!(matches!(fault, Fault::Bounds { .. } | Fault::Triangles { .. }), "{fault}");
        let fault = damaged(|c| c.records[5].primitive = 7);
        assert!(matches!(fault, Fault::Triangles { .. }), "{fault}");
        let fault = damaged(|c| {
            let leaf = c.nodes.iter().position(|n| n.child_0 & BVH_LEAF != 0).expect("there are leaves");
            let records = c.records.len() as u32;
            c.nodes[leaf].child_0 = BVH_LEAF | (records - 1);
        });
        assert!(matches!(fault, Fault::Bounds { .. } | Fault::Leaves { .. }), "{fault}");
    }
}

/// Such damage where nodes hold four children.
#[test]
fn damaged_trees_of_four_children_per_node_are_noticed() {
    let bench = Bench::new();
    let sound = build(&bench, Config::new(Builder::Sah), &scattered(300, 10, 0.2));
    let damaged = |damage: fn(&mut Contents)| {
        let mut contents = sound.clone();
        damage(&mut contents);
        well_formed(&contents).expect_err("the damage is noticed")
    };
    // A lower side one step farther, an upper side one step nearer, and steps that are too large.
    let fault = damaged(|c| c.nodes_of_four[1].z[0] += 1 << 16);
    assert!(matches!(fault, Fault::Bounds { link: 6, .. }), "{fault}");
    let fault = damaged(|c| c.nodes_of_four[0].x[1] -= 1 << 24);
    assert!(matches!(fault, Fault::Bounds { link: 3, .. }), "{fault}");
    let fault = damaged(|c| c.nodes_of_four[0].steps += 1);
    assert!(matches!(fault, Fault::Bounds { .. }), "{fault}");
    let fault = damaged(|c| c.nodes_of_four[2].parent ^= 1);
    assert!(matches!(fault, Fault::Parent { node: 2, .. }), "{fault}");
    let fault = damaged(|c| c.nodes_of_four[0].children[2] = c.nodes_of_four.len() as u32);
    assert!(matches!(fault, Fault::Dangling { .. }), "{fault}");
    let fault = damaged(|c| c.nodes_of_four[0].children[1] = BVH_NONE);
    assert!(matches!(fault, Fault::Bounds { .. } | Fault::Leaves { .. }), "{fault}");
    let fault = damaged(|c| c.records[5].primitive = 7);
    assert!(matches!(fault, Fault::Triangles { .. }), "{fault}");
}

#[test]
fn a_tree_of_the_host_is_asked_for_and_serves_one_build() {
    let bench = Bench::new();
    let geometry = bench.geometry(&scattered(20, 11, 0.2));
    let mut bvh = Bvh::new(bench.device(), Config::new(Builder::Sah), &geometry, None).expect("valid");
    for _ in 0..2 {
        let recorded = bench.device().submit(|recorder| bvh.record_build(recorder, 0, [0.0; 3].into()));
        let error = recorded.expect("the device works").value.expect_err("nothing was prepared");
        assert!(error.to_string().contains("prepare_build"), "{error}");
        bvh.prepare_build(bench.device()).expect("the device works");
        let recorded = bench.device().submit(|recorder| bvh.record_build(recorder, 0, [0.0; 3].into()));
        recorded.expect("the device works").value.expect("it was prepared");
        assert!(bvh.status(0).expect("readable").complete);
    }
}

/// Pools of every edge capacity, one smaller than the tree or all of them: nothing is answered, and what is
/// grown to its demand answers as if it had had capacity.
#[test]
fn every_edge_capacity() {
    let bench = Bench::new();
    let device = bench.device();
    let triangles = scattered(700, 9, 0.5);
    let geometry = bench.geometry(&triangles);
    let rays = Random::new(10).rays(500, -6.0, 6.0);
    for config in kinds() {
        let full = plan(&config, triangles.len() as u64).expect("in range");
        let mut bvh = Bvh::new(device, config, &geometry, None).expect("the options are valid");
        assert!(bench.build_once(&mut bvh, [0.0; 3]).complete);
        let (expected, _) = trace_in_rounds(&bench, &bvh, &rays, TraceMode::Closest, 4);
        assert!(expected.iter().filter(|hit| hit.is_hit()).count() > 50);
        for (index, pool) in full.pools.iter().enumerate().skip(1) {
            let n = pool.elements;
            for capacity in [0, 1, n / 2, n - 1, n] {
                let what = format!("{config:?}, capacity {capacity} of {n} {}", pool.name);
                let mut sizes = full.clone();
                sizes.pools[index].elements = capacity;
                bvh.resize(device, &sizes).expect("it fits");
                let status = bench.build_once(&mut bvh, [0.0; 3]);
                assert_eq!(status.complete, capacity == n, "{what}");
                if let Check::Grow(sizes) = bvh.check(&status, 0).expect("sizes that do") {
                    let (hits, counters) = trace_in_rounds(&bench, &bvh, &rays, TraceMode::Closest, 4);
                    assert_eq!(counters.not_ready as usize, rays.len(), "{what}");
                    assert!(hits.iter().all(|hit| !hit.is_hit()), "{what}: a partial answer");
                    bvh.resize(device, &sizes).expect("it fits");
                    assert!(bench.build_once(&mut bvh, [0.0; 3]).complete, "{what}, grown");
                } else {
                    assert_eq!(capacity, n, "{what}");
                }
                let (hits, _) = trace_in_rounds(&bench, &bvh, &rays, TraceMode::Closest, 4);
                assert_eq!(hits, expected, "{what}");
            }
        }
    }
}

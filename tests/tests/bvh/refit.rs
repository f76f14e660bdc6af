//! Trees that are kept: which builds may keep one, that boxes are exact, what kept trees cost as triangles
//! move, and when they are given up.

use rasray_ads::{
    BoundsPass, BufferOffset, Counters, Geometry, GeometryDesc, Ray, Structure, TraceMode, Viewpoint,
};
use rasray_bvh::{
    Addressing, Builder, Bvh, Children, Chunks, Config, Contents, Loads, NodeOfFour, well_formed,
};
use rasray_gpu::{BufferUsage, Timing};
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::rays::towards;
use rasray_tests::shapes::{Triangle, bounds, closed_box, sphere};
use rasray_tests::tier::first;
use rasray_tracer::build_until_complete;

use super::scenes::{frame_of, scene as built_in};

/// A kernel of builds by Morton codes; builds that keep their order do without.
const SORT: &str = "bvh/build_5_scatter";
const REFIT: &str = "bvh/build_9_refit";

const RAYS: usize = 1500;

fn scene() -> Vec<Triangle> {
    let mut triangles = sphere([-1.0, 0.5, 0.25], 1.5, 12);
    triangles.extend(sphere([2.0, -0.5, 1.0], 1.0, 9));
    triangles.extend(closed_box([-4.0; 3], [4.0; 3]));
    triangles
}

/// Positions of the triangles at a step: bent and stretched, step 0 as they are.
fn moved(triangles: &[Triangle], step: usize) -> Vec<Triangle> {
    let s = step as f32;
    let place = |[x, y, z]: [f32; 3]| [x + 0.7 * s * y, y * (1.0 + 0.4 * s), z - s * x * x * 0.3];
    triangles.iter().map(|triangle| triangle.map(place)).collect()
}

/// Triangles on the device, with what moves them.
struct Setup {
    bench: Bench,
    geometry: Geometry,
    bounds: BoundsPass,
}

impl Setup {
    fn new(triangles: &[Triangle]) -> Self {
        let bench = Bench::new();
        let geometry = bench.geometry(triangles);
        let bounds = BoundsPass::new(bench.device()).expect("the device works");
        Self { bench, geometry, bounds }
    }

    fn tree(&self, config: Config) -> Bvh {
        Bvh::new(self.bench.device(), config, &self.geometry, None).expect("the options are valid")
    }

    /// Puts the triangles elsewhere; without `measured` the bounds stay.
    fn put(&self, triangles: &[Triangle], measured: bool) {
        let device = self.bench.device();
        device.upload_slice(&self.geometry.desc().positions.buffer, 0, triangles).expect("they fit");
        if measured {
            device.submit(|recorder| self.bounds.record(recorder, &self.geometry)).expect("the device works");
        }
    }

    /// Records a build into a slot; without `submitted` the recording is thrown away.
    fn record(&self, tree: &mut Bvh, slot: u32, submitted: bool) -> Vec<String> {
        let device = self.bench.device();
        if !submitted {
            let refused = device.submit(|recorder| {
                tree.record_build(recorder, slot, Viewpoint::from([0.0; 3])).expect("recorded");
                recorder.refuse("the test wants it thrown away");
            });
            refused.expect_err("nothing is submitted");
            return Vec::new();
        }
        let submitted = device.submit_passes(Timing::Host, |recorder| {
            tree.record_build(recorder, slot, Viewpoint::from([0.0; 3]))
        });
        let submitted = submitted.expect("the device works");
        submitted.value.expect("recorded");
        submitted.passes.into_iter().map(|pass| pass.label).collect()
    }

    /// Builds, reads the status, and answers whether the order was kept.
    fn build(&self, tree: &mut Bvh) -> bool {
        let labels = self.record(tree, 0, true);
        assert!(tree.status(0).expect("readable").complete);
        keeps_order(&labels)
    }

    /// Levels of nodes of a tree, whose boxes and links are checked.
    fn levels(&self, tree: &Bvh) -> usize {
        let contents = tree.download(self.bench.device()).expect("readable");
        well_formed(&contents).unwrap_or_else(|fault| panic!("{fault}")).levels
    }

    /// Cost of a tree beyond that of triangles, and the nodes that a ray reads on average. The header of a
    /// tree that may be kept, or is, has the same cost.
    fn cost(&self, tree: &Bvh, triangles: &[Triangle], what: &str) -> [f64; 2] {
        let contents = tree.download(self.bench.device()).expect("readable");
        let shape = well_formed(&contents).unwrap_or_else(|fault| panic!("{what}: {fault}"));
        let cost = shape.cost - 1.0 - cost_of_triangles(triangles);
        if tree.config().builder == Builder::Refit {
            let told = contents.header.cost.map(f64::from);
            let told = told[0] / 2.0_f64.powi(32) + told[1];
            assert!((told - cost).abs() < 1.0e-4 * cost, "{what}: the header has {told}, the tree {cost}");
        }
        let rays = rays_into(triangles);
        let (_, counters) = trace_in_rounds(&self.bench, tree, &rays, TraceMode::Closest, tree.rounds());
        [cost, counters.entries as f64 / rays.len() as f64]
    }

    /// Hits of a tree, and those of one that was made for where the triangles are now.
    fn same_hits(&self, tree: &Bvh, triangles: &[Triangle], what: &str) {
        let geometry = self.bench.geometry(triangles);
        let device = self.bench.device();
        let mut fresh = Bvh::new(device, Config::new(Builder::Lbvh), &geometry, None).expect("valid");
        build_until_complete(device, &mut fresh, [0.0; 3], Timing::None).expect("a build");
        let rays = Random::new(77).rays(RAYS, -3.5, 3.5);
        for mode in [TraceMode::Closest, TraceMode::Occluded] {
            let of = |tree: &Bvh| {
                let rounds = if tree.config().work_budget.is_some() { 600 } else { tree.rounds() };
                let (hits, counters) = trace_in_rounds(&self.bench, tree, &rays, mode, rounds);
                assert_eq!(
                    (counters.unfinished, counters.not_ready, counters.corrupted),
                    (0, 0, 0),
                    "{what}"
                );
                match mode {
                    TraceMode::Closest => hits.iter().map(bits).collect::<Vec<_>>(),
                    TraceMode::Occluded => hits.iter().map(|hit| [u32::from(hit.is_hit()); 4]).collect(),
                }
            };
            let expected = of(&fresh);
            // Hardly any ray hits one of a few triangles.
            let hit = expected.iter().filter(|hit| **hit != expected[0]).count();
            assert!(triangles.len() < 20 || hit > RAYS / 50 || mode == TraceMode::Occluded, "{what}");
            assert_eq!(of(tree), expected, "{what}, {mode:?}");
        }
    }
}

/// Children and parent of every node.
fn links(contents: &Contents) -> Vec<[u32; 5]> {
    let of_node = |node: &NodeOfFour| {
        let [a, b, c, d] = node.children;
        [a, b, c, d, node.parent]
    };
    contents.nodes_of_four.iter().map(of_node).collect()
}

fn keeps_order(labels: &[String]) -> bool {
    let has = |wanted: &str| labels.iter().any(|label| label == wanted);
    assert_ne!(has(SORT), has(REFIT), "{labels:?}");
    has(REFIT)
}

#[test]
fn later_builds_find_only_the_boxes_anew() {
    let triangles = scene();
    let base = Config::new(Builder::Refit);
    let address = Config { addressing: Addressing::Address, ..base };
    let shared = Config { chunks: Some(Chunks::Shared), leaf: Some(1), ..base };
    let words = Config { loads: Some(Loads::Bits32), ..address };
    for config in [base, address, shared, words, Config { work_budget: Some(3), ..base }] {
        let stage = Setup::new(&triangles);
        let mut tree = stage.tree(config);
        assert!(!stage.build(&mut tree), "the first build has no order to keep");
        let first = tree.download(stage.bench.device()).expect("readable");
        for step in 1..4 {
            let now = moved(&triangles, step);
            stage.put(&now, true);
            assert!(stage.build(&mut tree), "build {step}");
            let contents = tree.download(stage.bench.device()).expect("readable");
            well_formed(&contents).unwrap_or_else(|fault| panic!("build {step}: {fault}"));
            for (record, before) in contents.records.iter().zip(&first.records) {
                assert_eq!(record.primitive, before.primitive);
                assert_eq!(record.corners(), now[record.primitive as usize]);
            }
            assert!(contents.nodes_of_four != first.nodes_of_four);
            assert_eq!(links(&contents), links(&first), "build {step}");
            stage.same_hits(&tree, &now, &format!("{config:?}, build {step}"));
        }
    }
}

#[test]
fn small_trees_are_refitted() {
    for (count, leaf) in [0_usize, 1, 2, 3, 4, 5, 17].into_iter().flat_map(|count| [(count, 1), (count, 4)]) {
        let triangles: Vec<Triangle> = scene().into_iter().take(count).collect();
        let stage = Setup::new(&triangles);
        let mut tree = stage.tree(Config { leaf: Some(leaf), ..Config::new(Builder::Refit) });
        stage.record(&mut tree, 0, true);
        assert!(tree.status(0).expect("readable").complete);
        let now = moved(&triangles, 2);
        stage.put(&now, true);
        let labels = stage.record(&mut tree, 0, true);
        assert!(!labels.iter().any(|label| label == SORT), "{count}: {labels:?}");
        assert!(tree.status(0).expect("readable").complete, "{count}");
        let contents = tree.download(stage.bench.device()).expect("readable");
        well_formed(&contents).unwrap_or_else(|fault| panic!("{count} triangles: {fault}"));
        if count > 0 {
            stage.same_hits(&tree, &now, &format!("{count} triangles"));
        }
    }
}

/// A recorded build may never run, run later, or be incomplete: only a status that was read says that there
/// is an order.
#[test]
fn only_an_order_that_is_known_to_exist_is_kept() {
    let triangles = scene();
    let stage = Setup::new(&triangles);
    let device = stage.bench.device();
    let mut tree = stage.tree(Config::new(Builder::Refit));
    tree.set_slots(device, 2).expect("two slots");
    stage.record(&mut tree, 0, false);
    assert!(!keeps_order(&stage.record(&mut tree, 0, true)), "the build before was never submitted");
    assert!(!keeps_order(&stage.record(&mut tree, 1, true)), "no status was read yet");
    assert!(tree.status(0).expect("readable").complete);
    assert!(keeps_order(&stage.record(&mut tree, 1, true)));
    // Triangles outside of their bounds: the first build of an order is not complete, and none follows it.
    let mut other = stage.tree(Config::new(Builder::Refit));
    let now = moved(&triangles, 3);
    stage.put(&now, false);
    assert!(!keeps_order(&stage.record(&mut other, 0, true)));
    let status = other.status(0).expect("readable");
    assert!(!status.complete && status.outside > 0);
    stage.put(&now, true);
    assert!(!stage.build(&mut other), "the build before was incomplete");
    assert!(stage.build(&mut other));
    stage.same_hits(&other, &now, "after an incomplete build");
    // An incomplete build after an order was known: that order still stands.
    stage.put(&moved(&triangles, 5), false);
    assert!(keeps_order(&stage.record(&mut other, 0, true)));
    assert!(!other.status(0).expect("readable").complete);
    stage.put(&now, true);
    assert!(stage.build(&mut other));
    stage.same_hits(&other, &now, "after a later build that was incomplete");
}

#[test]
fn other_triangles_or_pools_are_ordered_anew() {
    let triangles = scene();
    let stage = Setup::new(&triangles);
    let device = stage.bench.device();
    let mut tree = stage.tree(Config::new(Builder::Refit));
    tree.set_slots(device, 2).expect("two slots");
    assert!(!stage.build(&mut tree));
    assert!(stage.build(&mut tree));
    // A frame in flight was recorded before the triangles changed, and its status is read after.
    stage.record(&mut tree, 1, true);
    let fewer: Vec<Triangle> = triangles.iter().copied().skip(40).collect();
    tree.set_geometry(device, &stage.bench.geometry(&fewer)).expect("the pools fit");
    assert!(tree.status(1).expect("readable").was_complete);
    assert!(!stage.build(&mut tree), "other triangles");
    stage.same_hits(&tree, &fewer, "fewer triangles");
    assert!(stage.build(&mut tree));
    stage.same_hits(&tree, &fewer, "fewer triangles, refitted");
    let more: Vec<Triangle> = triangles.iter().copied().chain(moved(&triangles, 1)).collect();
    tree.set_geometry(device, &stage.bench.geometry(&more)).expect("the pools fit");
    assert!(!stage.build(&mut tree), "more triangles");
    stage.same_hits(&tree, &more, "more triangles");
    assert!(stage.build(&mut tree));
    let mut sizes = tree.sizes().clone();
    sizes.pools[1].elements += 1;
    tree.resize(device, &sizes).expect("it fits");
    assert!(!stage.build(&mut tree), "other pools");
    // Words written from outside may be anything.
    let contents = tree.download(device).expect("readable");
    let mut damaged = contents.clone();
    damaged.nodes_of_four.iter_mut().for_each(|node| node.children = [0; 4]);
    // SAFETY: the header is the one that was downloaded, and nothing was resized since.
    unsafe { tree.upload(device, &damaged) }.expect("it fits");
    assert!(!stage.build(&mut tree), "pools that were written from outside");
    stage.same_hits(&tree, &more, "after damage");
}

/// Where the device counts the triangles, every build may have another number of them.
#[test]
fn what_the_device_counts_is_ordered_by_every_build() {
    let triangles = scene();
    let stage = Setup::new(&triangles);
    let device = stage.bench.device();
    let count = |shown: usize| {
        let words = [shown as u32];
        device.create_buffer_with("count", BufferUsage::ALL, &words).expect("memory")
    };
    let buffer = count(triangles.len());
    let desc = GeometryDesc {
        count: Some(BufferOffset { buffer: buffer.clone(), offset: 0 }),
        ..stage.geometry.desc().clone()
    };
    let geometry = Geometry::new(device, desc).expect("it fits");
    let mut tree = Bvh::new(device, Config::new(Builder::Refit), &geometry, None).expect("valid");
    assert!(!stage.build(&mut tree));
    let shown = triangles.len() / 2;
    device.upload_slice(&buffer, 0, &[shown as u32]).expect("memory");
    assert!(!stage.build(&mut tree));
    stage.same_hits(&tree, &triangles[..shown], "half of the triangles");
}

/// The cost of trees beyond that of triangles and the nodes that rays read, along clips: of a tree that is
/// kept while it stays good, and of those that are made anew.
#[test]
fn a_tree_that_is_kept_stays_about_as_good_as_a_new_one() {
    let clips = [("walker:10k", 30), ("cloth-ball:1k", 30), ("walker:30k", 100), ("cloth-ball", 100)];
    for (name, frames) in first(&clips, 2) {
        let scene = built_in(name);
        let stage = Setup::new(&frame_of(&scene, 0));
        let of = |builder| Config {
            children: Some(Children::Four),
            counters: Counters::Sums,
            ..Config::new(builder)
        };
        let [mut kept, mut lbvh] = [Builder::Refit, Builder::Lbvh].map(|builder| stage.tree(of(builder)));
        let mut made_in = Vec::new();
        let mut sums = [0.0; 3];
        for frame in 0..=*frames {
            let now = frame_of(&scene, frame);
            stage.put(&now, true);
            if !stage.build(&mut kept) {
                made_in.push(frame);
            }
            if frame % 10 > 0 {
                continue;
            }
            let mut made = stage.tree(of(Builder::Refit));
            assert!(!stage.build(&mut made));
            stage.record(&mut lbvh, 0, true);
            assert!(lbvh.status(0).expect("readable").complete);
            let [kept, made, lbvh] =
                [&kept, &made, &lbvh].map(|tree| stage.cost(tree, &now, &format!("{name}, frame {frame}")));
            println!(
                "{name}, frame {frame}: cost, nodes per ray: kept {kept:.4?}, new {made:.4?}, lbvh {lbvh:.4?}"
            );
            assert!(kept[0] < 1.3 * made[0] && kept[1] < 1.4 * made[1], "{name}, frame {frame}");
            for (sum, [_, entries]) in sums.iter_mut().zip([kept, made, lbvh]) {
                *sum += entries;
            }
        }
        let means = sums.map(|sum| sum / (frames / 10 + 1) as f64);
        println!("{name}: made in frames {made_in:?}; nodes per ray: kept, new, lbvh {means:.2?}");
        assert!(made_in[0] == 0 && made_in.len() <= 1 + frames / 10, "{name}: {made_in:?}");
        assert!(sums[0] < 1.2 * sums[1] && sums[0] < sums[2], "{name}: kept, new, lbvh: {sums:?}");
    }
}

/// Sum of the areas of the boxes of triangles, over the area of the box of all.
fn cost_of_triangles(triangles: &[Triangle]) -> f64 {
    let area = |[lower, upper]: [[f32; 3]; 2]| {
        let side = |axis: usize| f64::from(upper[axis]) - f64::from(lower[axis]);
        side(0) * side(1) + side(1) * side(2) + side(2) * side(0)
    };
    triangles.iter().map(|triangle| area(bounds(&[*triangle]))).sum::<f64>() / area(bounds(triangles))
}

/// Triangles that are put in places without order make every kept tree a bad one.
#[test]
fn a_tree_whose_boxes_have_grown_is_given_up() {
    let triangles = scene();
    let stage = Setup::new(&triangles);
    let mut tree = stage.tree(Config::new(Builder::Refit));
    let mut random = Random::new(11);
    let kept: Vec<bool> = (0..12)
        .map(|_| {
            let mut now = triangles.clone();
            for place in (1..now.len()).rev() {
                now.swap(place, (random.bits() % (place as u64 + 1)) as usize);
            }
            stage.put(&now, true);
            let kept = stage.build(&mut tree);
            stage.same_hits(&tree, &now, "triangles without order");
            kept
        })
        .collect();
    // A bad tree is noticed after one build, and then none is kept for 1, 2, 4 ... builds.
    let expected = [1, 3, 6, 11];
    assert_eq!((0..12).filter(|build| kept[*build]).collect::<Vec<_>>(), expected);
    for build in 0..30 {
        assert!(stage.build(&mut tree) || build < 8, "the triangles rest, build {build}");
    }
}

/// With several frames in flight, the tree in the pools may have more levels than the one that the host
/// knows.
#[test]
fn a_kept_tree_may_be_deeper_than_the_host_knows() {
    // Triangles in a grid, and triangles each three times as far and as large as the one before.
    let grid = |i: usize| ([i % 4, i / 4 % 4, i / 16].map(|c| c as f32), 0.3);
    let series =
        |i: usize| ([3.0_f32.powi(i as i32 % 24) * 1.0e-3, 0.0, 0.0], 1.0e-3 * 3.0_f32.powi(i as i32 % 24));
    let made = |of: &dyn Fn(usize) -> ([f32; 3], f32), turn: f32| -> Vec<Triangle> {
        let triangle = |i| {
            let ([x, y, z], size) = of(i);
            [[x, y, z], [x + 0.2 * size, y + size, z + turn * size], [x - turn * size, y, z + size]]
        };
        (0..24).map(triangle).collect()
    };
    let (shallow, deep, moved) = (made(&grid, 0.0), made(&series, 0.0), made(&series, 0.1));
    let stage = Setup::new(&shallow);
    let mut tree = stage.tree(Config { leaf: Some(1), ..Config::new(Builder::Refit) });
    tree.set_slots(stage.bench.device(), 2).expect("two slots");
    assert!(!keeps_order(&stage.record(&mut tree, 0, true)));
    let known = stage.levels(&tree);
    stage.put(&deep, true);
    assert!(!keeps_order(&stage.record(&mut tree, 1, true)));
    let levels = stage.levels(&tree);
    assert!(levels > known + 2, "{levels} and {known} levels");
    assert!(tree.status(0).expect("readable").was_complete);
    stage.put(&moved, true);
    assert!(keeps_order(&stage.record(&mut tree, 0, true)));
    assert_eq!(stage.levels(&tree), levels);
    assert!(tree.status(0).expect("readable").complete);
    stage.same_hits(&tree, &moved, "a deeper tree");
}

/// Rays from around triangles to points on them.
fn rays_into(triangles: &[Triangle]) -> Vec<Ray> {
    let mut random = Random::new(5);
    let bounds = bounds(triangles);
    (0..2000)
        .map(|_| {
            let origin = random.within(bounds);
            let target = triangles[(random.bits() % triangles.len() as u64) as usize][0];
            towards(origin, target)
        })
        .collect()
}

//! Trees that keep the order of their first build: which builds may, that boxes are exact, and what they cost
//! as they go on.

use rasray_ads::{
    BoundsPass, BufferOffset, Counters, Geometry, GeometryDesc, Ray, Structure, TraceMode, Viewpoint,
};
use rasray_bvh::{Addressing, Builder, Bvh, Children, Config, Contents, well_formed};
use rasray_gpu::{BufferUsage, Timing};
use rasray_shaders_glsl::constants::bvh::BVH_LEAF;
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
    let two = contents.nodes.iter().map(|node| [node.child_0, node.child_1, node.parent, 0, 0]);
    let four = contents.nodes_of_four.iter().map(|node| {
        let [a, b, c, d] = node.children;
        [a, b, c, d, node.parent]
    });
    two.chain(four).collect()
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
    let four = Config { children: Some(Children::Four), ..base };
    let address = |config| Config { addressing: Addressing::Address, ..config };
    for config in [base, four, address(base), address(four), Config { work_budget: Some(3), ..four }] {
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
            assert!(contents.nodes != first.nodes || contents.nodes_of_four != first.nodes_of_four);
            if config.made_children() == Children::Two {
                assert_eq!(links(&contents), links(&first), "build {step}");
            }
            stage.same_hits(&tree, &now, &format!("{config:?}, build {step}"));
        }
    }
}

#[test]
fn small_trees_are_refitted() {
    let counts = [0_usize, 1, 2, 3, 4, 5, 17];
    for (count, children) in
        counts.into_iter().flat_map(|count| [(count, Children::Two), (count, Children::Four)])
    {
        let triangles: Vec<Triangle> = scene().into_iter().take(count).collect();
        let stage = Setup::new(&triangles);
        let mut tree = stage.tree(Config { children: Some(children), ..Config::new(Builder::Refit) });
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
    damaged.nodes.iter_mut().for_each(|node| (node.child_0, node.child_1) = (0, 0));
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

/// The cost of trees by surface area and the nodes that rays read, along clips: of one that is refitted from
/// frame to frame, and of those that are made anew.
#[test]
fn a_tree_that_is_refitted_stays_better_than_those_by_codes() {
    let clips = [("walker:10k", 30), ("cloth-ball:1k", 30), ("walker:30k", 100), ("cloth-ball", 100)];
    for (name, frames) in first(&clips, 2) {
        let scene = built_in(name);
        let stage = Setup::new(&frame_of(&scene, 0));
        let of = |builder| Config {
            children: Some(Children::Two),
            counters: Counters::Sums,
            ..Config::new(builder)
        };
        let [mut refit, mut lbvh, mut trbvh] =
            [Builder::Refit, Builder::Lbvh, Builder::Trbvh].map(|builder| stage.tree(of(builder)));
        let mut firsts = Vec::new();
        for frame in 0..=*frames {
            let now = frame_of(&scene, frame);
            stage.put(&now, true);
            assert_eq!(stage.build(&mut refit), frame > 0, "{name}, frame {frame}");
            if frame % 10 > 0 {
                continue;
            }
            for tree in [&mut lbvh, &mut trbvh] {
                stage.record(tree, 0, true);
                assert!(tree.status(0).expect("readable").complete);
            }
            if frame == 0 {
                let of = |tree: &Bvh| tree.download(stage.bench.device()).expect("readable");
                firsts.extend([&lbvh, &refit].map(of));
            }
            let kept: Vec<f64> = firsts.iter().map(|first| cost_of_kept(first, &now)).collect();
            let of = |tree: &Bvh| {
                let contents = tree.download(stage.bench.device()).expect("readable");
                let shape = well_formed(&contents).unwrap_or_else(|fault| panic!("{name}, {frame}: {fault}"));
                let rays = rays_into(&now);
                let (_, counters) =
                    trace_in_rounds(&stage.bench, tree, &rays, TraceMode::Closest, tree.rounds());
                [shape.cost, counters.entries as f64 / rays.len() as f64]
            };
            let [refit, lbvh, trbvh] = [&refit, &lbvh, &trbvh].map(of);
            println!(
                "{name}, frame {frame}: cost, nodes per ray: {refit:.2?}, lbvh {lbvh:.2?}, trbvh {trbvh:.2?}; cost of the first lbvh, \
                 trbvh: {kept:.2?}"
            );
            assert!(
                (refit[0] - kept[1]).abs() < 1.0e-5 * kept[1],
                "{name}, frame {frame}: {refit:?} and {kept:?}"
            );
            assert!(refit[0] < lbvh[0], "{name}, frame {frame}: {refit:?} and {lbvh:?}");
        }
    }
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

/// The cost of a tree of two children per node whose nodes stay, over triangles that have moved.
fn cost_of_kept(contents: &Contents, triangles: &[Triangle]) -> f64 {
    let mut contents = contents.clone();
    for record in &mut contents.records {
        [record.a, record.b, record.c] = triangles[record.primitive as usize];
    }
    // Nodes after their parents.
    let mut order = vec![contents.header.root];
    let mut next = 0;
    while let Some(&node) = order.get(next) {
        let children = contents.nodes[node as usize].children();
        order.extend(children.iter().map(|(child, _)| *child).filter(|child| child & BVH_LEAF == 0));
        next += 1;
    }
    for node in order.into_iter().rev() {
        for (slot, (child, _)) in (0..).zip(contents.nodes[node as usize].children()) {
            let points = match child & BVH_LEAF {
                0 => contents.nodes[child as usize].children().map(|(_, bounds)| bounds).concat(),
                _ => contents.records[(child & !BVH_LEAF) as usize].corners().to_vec(),
            };
            let lower = std::array::from_fn(|axis| points.iter().fold(f32::MAX, |m, p| m.min(p[axis])));
            let upper = std::array::from_fn(|axis| points.iter().fold(f32::MIN, |m, p| m.max(p[axis])));
            contents.nodes[node as usize].set_child(slot, child, [lower, upper]);
        }
    }
    well_formed(&contents).expect("the boxes are exact").cost
}

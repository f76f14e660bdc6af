//! The octree over the voxels: it says of each voxel what the grid says, and rays that skip its empty nodes
//! find the hits of rays that go from voxel to voxel, bit for bit.

use rasray_ads::{Addressing, Builder, Check, Counters, Ray, Structure, TraceMode};
use rasray_gpu::Timing;
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::{Bench, bits_of_any_build};
use rasray_tests::random::Random;
use rasray_tests::rays::along_axis;
use rasray_tests::shapes::{Triangle, all_sizes, sphere};
use rasray_tests::tier::is_pair;
use rasray_tests::voxels::{built, contents, hu, made};
use rasray_tracer::build_until_complete;
use rasray_voxel::{
    Config, Coverage, Demand, Fault, Leaves, March, Storage, Traversal, Voxels, formula_bytes, plan,
    well_formed,
};

fn octree(config: Config) -> Config {
    Config { traversal: Traversal::Octree, ..config }
}

/// Far apart, so that most nodes are empty, with slivers that cross many, and specks.
fn sparse() -> Vec<Triangle> {
    let mut random = Random::new(51);
    let mut triangles = sphere([-3.0, 0.5, -2.0], 1.5, 10);
    triangles.extend(sphere([4.0, 4.25, 4.5], 0.03, 8));
    for _ in 0..40 {
        let from = random.point(-8.0, 8.0);
        let to =
            if triangles.len().is_multiple_of(2) { random.point(-8.0, 8.0) } else { from.map(|x| x + 0.05) };
        triangles.push([from, to, random.near(from, 1.0e-2)]);
    }
    triangles
}

/// Rays in every direction; along axes; along sides and edges of voxels, exactly and nearly; through corners
/// of voxels.
fn rays(structure: &Voxels, count: usize) -> Vec<Ray> {
    let header = structure.header().expect("the header is readable");
    let mut random = Random::new(52);
    let side = |random: &mut Random, axis: usize| {
        let voxel = random.between(0.0, header.grid as f32).floor();
        header.lower[axis] + voxel * header.voxel
    };
    let ray = |index: usize| {
        let mut origin = random.point(-9.0, 9.0);
        let mut direction = random.direction();
        match index % 6 {
            0 => {
                let axis = index / 6 % 3;
                direction = along_axis(index / 6);
                for (other, x) in origin.iter_mut().enumerate() {
                    if other != axis && index / 36 % 4 > other {
                        *x = side(&mut random, other);
                    }
                }
            }
            1 => {
                origin = std::array::from_fn(|axis| side(&mut random, axis));
                direction = std::array::from_fn(|axis| {
                    [1.0, -1.0, 0.0][(random.between(0.0, 3.0) as usize + axis) % 3]
                });
                if direction == [0.0; 3] {
                    direction = [1.0; 3];
                }
            }
            2 => {
                let axis = index / 6 % 3;
                origin[axis] = side(&mut random, axis);
                direction[axis] = [0.0, 1e-7, -1e-6, 1e-4][index / 18 % 4];
            }
            3 => direction = direction.map(|x| 1e-3 * x),
            _ => {}
        }
        Ray::new(origin, direction)
    };
    (0..count).map(ray).collect()
}

/// Hits and occlusion, and what the rays did.
fn answers(
    bench: &Bench,
    config: Config,
    triangles: &[Triangle],
    count: usize,
) -> (Vec<[u32; 4]>, Vec<bool>, [u64; 2]) {
    let structure = built(bench, Config { counters: Counters::Sums, ..config }, triangles);
    let rays = rays(&structure, count);
    let outcome = bench.trace(&structure, &rays);
    let (hits, counters) = (outcome.hits, outcome.counters);
    assert_eq!(counters.corrupted, 0, "{config:?}");
    assert!(hits.iter().filter(|hit| hit.is_hit()).count() > count / 300, "{config:?}");
    let hits = hits.iter().map(bits_of_any_build).collect();
    (hits, bench.occluded(&structure, &rays), [counters.cells, counters.entries])
}

#[test]
fn hits_are_those_of_rays_that_visit_every_voxel() {
    let bench = Bench::new();
    let robust = |grid, resolution| Config { grid: Some(grid), ..Config::at_centres(resolution) };
    let voxels = |grid| Config { leaves: Leaves::Voxels, ..robust(grid, 64) };
    for (scene, triangles) in [sparse(), all_sizes()].into_iter().enumerate() {
        let configs = [
            robust(1, 64),
            robust(3, 64),
            robust(39, 64),
            robust(64, 64),
            Config { work_budget: Some(7), ..robust(32, 32) },
            robust(150, 64),
            Config { addressing: Addressing::Address, builder: Builder::Binning, ..robust(39, 64) },
            Config { coverage: Coverage::Conservative, ..robust(64, 64) },
            hu(64),
            Config { march: March::Exact, storage: Storage::Contiguous, grid: Some(32), ..hu(64) },
            voxels(37),
            voxels(128),
        ];
        let tried = configs.into_iter().enumerate().filter(|(place, _)| is_pair(scene, *place, 2));
        for (_, config) in tried {
            // By either traversal, so small a budget gives up a ray along the edges of voxels through lists
            // as long as those of all sizes.
            if scene == 1 && config.work_budget.is_some() {
                continue;
            }
            let (hits, occluded, [cells, entries]) = answers(&bench, config, &triangles, 6000);
            let (found, also_occluded, [fewer, more]) = answers(&bench, octree(config), &triangles, 6000);
            let differ = hits.iter().zip(&found).position(|(hit, found)| hit != found);
            assert_eq!(differ, None, "{config:?}: {:?}", differ.map(|ray| (hits[ray], found[ray])));
            assert!(occluded == also_occluded, "{config:?}");
            println!(
                "{} voxels: {fewer} for {cells} cells, {more} for {entries} entries and nodes",
                config.grid()
            );
            assert!(fewer <= cells && more > entries, "{config:?}");
        }
    }
}

/// More than half of the voxels that rays cross in a scene of few small parts lie in empty nodes.
#[test]
fn empty_nodes_are_skipped() {
    let bench = Bench::new();
    let config = Config { grid: Some(128), leaves: Leaves::Voxels, ..Config::at_centres(64) };
    let (_, _, [cells, _]) = answers(&bench, config, &sparse(), 4000);
    let (_, _, [fewer, _]) = answers(&bench, octree(config), &sparse(), 4000);
    assert!(2 * fewer < cells, "{fewer} of {cells} cells");
}

#[test]
fn the_octree_says_of_each_voxel_what_the_grid_says() {
    let bench = Bench::new();
    for (triangles, grid) in [(sparse(), 1), (sparse(), 5), (all_sizes(), 16), (sparse(), 100)] {
        let config = octree(Config { grid: Some(grid), ..Config::at_centres(48) });
        let structure = built(&bench, config, &triangles);
        let mut contents = contents(&bench, &structure);
        well_formed(&contents, triangles.len() as u32).expect("the octree is well formed");
        // As many nodes as there are blocks of 2, 4, 8 … voxels that hold something, up to the root.
        let occupied = |voxel: [u32; 3]| {
            let index = voxel.iter().rev().fold(0, |index, x| index * grid + x);
            contents.voxels[index as usize / 8] >> (4 * (index % 8)) & 15 != 0
        };
        let levels = contents.header.levels;
        let mut nodes = std::collections::HashSet::from([(levels, [0; 3])]);
        for index in 0..grid.pow(3) {
            let voxel = [index % grid, index / grid % grid, index / grid / grid];
            if occupied(voxel) {
                nodes.extend((1..=levels).map(|level| (level, voxel.map(|x| x >> level))));
            }
        }
        assert_eq!(contents.header.node_demand as usize, nodes.len());
        contents.nodes[0] ^= 1 << contents.nodes[0].trailing_zeros().min(7);
        let fault = well_formed(&contents, triangles.len() as u32);
        assert!(matches!(fault, Err(Fault::Octree { .. })), "{fault:?}");
    }
}

/// With less capacity than it takes no ray is answered, the pool grows to what it takes, and bytes are those
/// of the page.
#[test]
fn nodes_grow_to_what_they_take() {
    let bench = Bench::new();
    let (triangles, config) = (sparse(), octree(Config { grid: Some(64), ..Config::at_centres(64) }));
    let complete = built(&bench, config, &triangles);
    let header = complete.header().expect("the header is readable");
    let expected = bench.trace(&complete, &rays(&complete, 500)).hits;
    let demand =
        |nodes: u32| Demand { entries: header.demand.into(), nodes: nodes.into(), ..Demand::default() };
    let mut structure = made(&bench, config, &triangles);
    for nodes in [0, 1, header.node_demand - 1, header.node_demand] {
        structure.resize(bench.device(), &plan(&config, demand(nodes)).expect("in range")).expect("it fits");
        let status = bench.build_once(&mut structure, [0.0; 3]);
        assert_eq!(status.complete, nodes == header.node_demand, "capacity for {nodes}");
        if !status.complete {
            let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") else {
                panic!("capacity for {nodes} does not grow")
            };
            assert_eq!(sizes.elements("nodes"), Some(header.node_demand.into()));
            let rays = rays(&complete, 50);
            let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, TraceMode::Closest, 4);
            assert_eq!(counters.not_ready as usize, rays.len());
            assert!(hits.iter().all(|hit| !hit.is_hit()));
        }
    }
    let bytes = structure.report().expect("the header is readable").formula_bytes;
    assert_eq!(bytes, formula_bytes(&config, demand(header.node_demand)).total());
    assert_eq!(bytes, structure.sizes().bytes());
    assert_eq!(bench.trace(&structure, &rays(&structure, 500)).hits, expected);
    structure.resize(bench.device(), &plan(&config, demand(1)).expect("in range")).expect("it fits");
    build_until_complete(bench.device(), &mut structure, [0.0; 3], Timing::None).expect("it grows");
    assert_eq!(bench.trace(&structure, &rays(&structure, 500)).hits, expected);
}

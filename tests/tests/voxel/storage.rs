//! Contents of voxels and axis A-buffers, and what follows for rays: fragments saved against what geometry
//! allows, builds that repeat, and hits that do not depend on budgets and on how lists are kept.

use rasray_ads::{Hit, Ray, Structure};
use rasray_scene::facing::Facing;
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::rays::along_axis;
use rasray_tests::shapes::{Triangle, closed_box, sphere, with_twins};
use rasray_tests::tier::{first, in_turn};
use rasray_tests::voxels::{built, contents, hu, selective};
use rasray_voxel::{Accept, Axes, Config, Contents, Coverage, Fragment, March, Marking, Storage};

/// The share of fragments that keeping each triangle in one view can save: 1 - sum(max |n| A) / sum(|n|_1 A).
fn geometric_bound(triangles: &[Triangle]) -> f64 {
    let mut facing = Facing::default();
    for triangle in triangles {
        facing.add(triangle.map(|p| p.map(f64::from).into()));
    }
    facing.saved_by_one_view().expect("they have an area")
}

fn tilted(triangles: &[Triangle]) -> Vec<Triangle> {
    let (sine, cosine) = 0.7_f32.sin_cos();
    let turn = |[x, y, z]: [f32; 3]| [cosine * x - sine * y, sine * x + cosine * y, z];
    let lean = |[x, y, z]: [f32; 3]| [x, cosine * y - sine * z, sine * y + cosine * z];
    triangles.iter().map(|triangle| triangle.map(turn).map(lean)).collect()
}

/// The paper reports 64 to 66 %. What can be saved follows from the directions of surfaces: nothing on a box
/// along the axes, whose walls leave fragments in one view anyway, a third and more on others. More than that
/// is lost coverage.
#[test]
fn fragments_saved_are_those_that_geometry_allows() {
    const RESOLUTION: u32 = 256;
    let bench = Bench::new();
    let boxed = closed_box([-1.0; 3], [1.0; 3]);
    let scenes = [
        ("sphere", sphere([0.0; 3], 1.0, 24), 0.35),
        ("box", boxed.clone(), 0.0),
        ("tilted box", tilted(&boxed), 0.3),
    ];
    for (name, triangles, least) in scenes {
        let stored = |axes| {
            let config = Config { axes, coverage: Coverage::Exact, ..Config::at_centres(RESOLUTION) };
            let structure = built(&bench, config, &triangles);
            structure.report().expect("the header is readable").stored.expect("fragments are counted") as f64
        };
        let all = stored(Axes::All);
        let saved = 1.0 - stored(Axes::Triangle) / all;
        let by_voxel = 1.0 - stored(Axes::Voxel) / all;
        let bound = geometric_bound(&triangles);
        println!(
            "{name}: {:.2} % saved by triangles, {:.2} % by voxels, {:.2} % possible",
            100.0 * saved,
            100.0 * by_voxel,
            100.0 * bound
        );
        assert!(bound >= least, "{name}: {bound}");
        // A closed surface leaves as many fragments as its projections have cells, give or take its
        // silhouettes.
        let silhouettes = 8.0 / f64::from(RESOLUTION);
        assert!(
            saved <= bound + silhouettes,
            "{name} saves {saved} of its fragments, and {bound} is possible"
        );
        assert!(saved >= bound - silhouettes, "{name} saves {saved} of its fragments of {bound} possible");
        // A voxel on an edge between surfaces of two axes keeps those of one only: what is saved beyond the
        // bound is what rays will miss there.
        let edges = 2.0 / f64::from(Config::at_centres(RESOLUTION).grid());
        assert!((by_voxel - bound).abs() <= edges + silhouettes, "{name}: {by_voxel} of {bound}");
    }
}

/// The fragments of every list; of lists that are not sorted, in no particular order.
fn lists(contents: &Contents) -> Vec<Vec<Fragment>> {
    (0..contents.lists.len())
        .map(|list| {
            let mut fragments = contents.list(list).expect("the list is whole");
            if !contents.config.sorts() {
                fragments.sort_by(|a, b| a.z.total_cmp(&b.z).then(a.primitive.cmp(&b.primitive)));
            }
            fragments
        })
        .collect()
}

/// Sums of whole numbers do not depend on the order of threads: axes, lists and fragments are the same in
/// every build, and of every storage.
#[test]
fn builds_repeat_to_the_bit() {
    let bench = Bench::new();
    let mut triangles = sphere([0.3, 0.1, -0.2], 1.0, 16);
    triangles.extend(triangles.clone());
    triangles.extend(tilted(&closed_box([-0.5; 3], [0.5; 3])));
    let marked_before = Config { voxels: Some(Marking::Triangles), ..hu(64) };
    for config in [Config::at_centres(64), hu(64), marked_before, selective(64)] {
        let sorted = Config { storage: Storage::Contiguous, ..config };
        let first = contents(&bench, &built(&bench, sorted, &triangles));
        let expected = lists(&first);
        assert!(expected.iter().any(|list| list.len() > config.page as usize), "{config:?}");
        for storage in [Storage::Contiguous, Storage::Linked, Storage::Paged, config.storage] {
            let config = Config { storage, ..config };
            let again = contents(&bench, &built(&bench, config, &triangles));
            assert!(first.voxels == again.voxels && expected == lists(&again), "{config:?}");
            assert!(storage != Storage::Contiguous || first.lists == again.lists, "{config:?}");
        }
    }
}

fn rays(count: usize) -> Vec<Ray> {
    let mut random = Random::new(5);
    (0..count)
        .map(|index| {
            let origin = random.point(-3.0, 3.0);
            // Every fourth along an axis.
            let mut direction = random.direction();
            if index % 4 == 0 {
                direction = along_axis(index / 4);
            }
            Ray::new(origin, direction)
        })
        .collect()
}

fn bits(hits: &[Hit]) -> Vec<[u32; 4]> {
    hits.iter().map(|hit| [hit.t.to_bits(), hit.primitive, hit.a.to_bits(), hit.b.to_bits()]).collect()
}

/// A room with a sphere, and layers, so that lists are long; some of it twice, so that ids decide.
fn layered() -> Vec<Triangle> {
    let mut triangles = closed_box([-4.0; 3], [4.0; 3]);
    triangles.extend(sphere([1.0, 0.5, -1.5], 1.25, 12));
    // Layers, so that lists are long enough to be entered by bisection.
    triangles.extend((0..40).map(|k| {
        let z = -3.0 + 0.05 * k as f32;
        [[-3.0, -3.0, z], [2.0, -3.0, z], [-3.0, 2.0, z + 0.01]]
    }));
    with_twins(triangles)
}

/// A ray that pauses anywhere goes on where it was: in the midst of a list as well.
#[test]
fn budgets_change_no_hit() {
    let bench = Bench::new();
    let (triangles, rays) = (layered(), rays(200));
    for config in [
        Config::at_centres(32),
        Config { sort: false, ..Config::at_centres(32) },
        Config { storage: Storage::Linked, axes: Axes::All, ..Config::at_centres(32) },
        Config { storage: Storage::Paged, ..Config::at_centres(32) },
        hu(32),
        Config { storage: Storage::Contiguous, ..hu(32) },
        Config { storage: Storage::Contiguous, sort: false, ..hu(32) },
        Config { march: March::Exact, storage: Storage::Linked, ..selective(32) },
        Config { march: March::Exact, ..selective(32) },
    ] {
        let whole = built(&bench, config, &triangles);
        let expected = bench.trace(&whole, &rays).hits;
        let occluded = bench.occluded(&whole, &rays);
        assert!(occluded.iter().filter(|hit| **hit).count() > rays.len() / 2);
        for budget in [1, 3, 40] {
            let structure = built(&bench, Config { work_budget: Some(budget), ..config }, &triangles);
            assert_eq!(bits(&bench.trace(&structure, &rays).hits), bits(&expected), "{budget}: {config:?}");
            assert_eq!(bench.occluded(&structure, &rays), occluded, "{budget}: {config:?}");
        }
    }
}

/// However lists are kept, and in whatever order they are read: the same hits, of triangles that coincide as
/// well.
#[test]
fn storages_change_no_hit() {
    let bench = Bench::new();
    let (mut triangles, rays) = (layered(), rays(2000));
    triangles.extend(tilted(&sphere([-1.0, 0.5, 1.5], 1.5, 12)));
    let configs = [
        Config::at_centres(64),
        Config { coverage: Coverage::Conservative, ..Config::at_centres(16) },
        hu(64),
        Config { march: March::Exact, ..hu(48) },
        selective(64),
        Config { accept: Accept::Parity, ..Config::at_centres(64) },
    ];
    for (index, config) in configs.into_iter().enumerate() {
        let expected = built(&bench, Config { storage: Storage::Contiguous, ..config }, &triangles);
        let (expected, occluded) =
            (bits(&bench.trace(&expected, &rays).hits), bench.occluded(&expected, &rays));
        assert!(occluded.iter().filter(|hit| **hit).count() > rays.len() / 16, "{config:?}");
        let unsorted = Config { storage: Storage::Contiguous, sort: false, ..config };
        let linked = Config { storage: Storage::Linked, ..config };
        let paged = |page| Config { storage: Storage::Paged, page, ..config };
        let alone = [paged(1), paged(7)];
        for &config in in_turn(&[unsorted, linked, paged(4)], index).iter().chain(first(&alone, 0)) {
            let structure = built(&bench, config, &triangles);
            assert!(bits(&bench.trace(&structure, &rays).hits) == expected, "{config:?}");
            assert!(bench.occluded(&structure, &rays) == occluded, "{config:?}");
        }
    }
}

/// Each wall of a box is seen by one view, so hits are exact at every resolution, odd ones and 1 included.
#[test]
fn a_room_is_exact_at_every_resolution() {
    let bench = Bench::new();
    let triangles = closed_box([-2.0; 3], [2.0; 3]);
    let rays = Random::new(4).rays(1000, -1.9, 1.9);
    for (resolution, grid) in [(1, 1), (2, 5), (3, 3), (7, 2), (33, 64), (100, 17), (255, 28)] {
        let config = Config { grid: Some(grid), ..Config::at_centres(resolution) };
        let structure = built(&bench, config, &triangles);
        let hits = bench.trace(&structure, &rays).hits;
        let occluded = bench.occluded(&structure, &rays);
        for (ray, hit) in hits.iter().enumerate() {
            let Ray { origin, direction, .. } = rays[ray];
            let expected = (0..3)
                .map(|k| {
                    (2.0_f64.copysign(direction[k].into()) - f64::from(origin[k])) / f64::from(direction[k])
                })
                .fold(f64::INFINITY, f64::min);
            assert!(hit.is_hit() && occluded[ray], "{resolution}, {grid}: {:?}", rays[ray]);
            let difference = (f64::from(hit.t) - expected).abs();
            assert!(difference <= 4e-6 * expected.max(1e-2), "{resolution}, {grid}: {hit:?} for {expected}");
        }
    }
}

/// As many cells as a dispatch may step through, in one voxel, and what lies behind them is still found: the
/// traversal fits the loops that a driver allows.
#[test]
fn a_traversal_as_long_as_the_budget_reaches_its_end() {
    let bench = Bench::new();
    let plate = |x: f32, y: f32, z: f32| [[x, y - 0.1, z], [x + 0.1, y, z], [x - 0.1, y + 0.1, z]];
    let triangles = [plate(-0.9, -0.9, -1.0), plate(0.9, 0.9, 0.0), plate(-0.9, 0.9, 1.0)];
    let config = Config { grid: Some(1), ..Config::at_centres(2048) };
    let structure = built(&bench, config, &triangles);
    let rays: Vec<Ray> = (0..64)
        .map(|k| {
            let origin = [-0.99, -0.98 + 1e-3 * k as f32, 0.1];
            Ray::new(origin, std::array::from_fn(|axis| [0.9, 0.9, 0.0][axis] - origin[axis]))
        })
        .collect();
    for hit in bench.trace(&structure, &rays).hits {
        assert!(hit.primitive == 1 && (hit.t - 1.0).abs() < 1e-5, "{hit:?}");
    }
}

#[test]
fn limits_and_exclusion_are_kept() {
    let bench = Bench::new();
    let triangles: Vec<Triangle> =
        [2.0, 3.0, 4.0].map(|z| [[-9.0, -9.0, z], [9.0, -9.0, z], [0.0, 18.0, z]]).to_vec();
    let structure = built(&bench, Config::at_centres(32), &triangles);
    let ray = Ray::new([0.1, -0.2, 0.0], [0.1, 0.2, 1.0]);
    let rays = [
        ray,
        Ray { t_max: 2.0_f32.next_down(), ..ray },
        Ray { t_max: 2.5, ..ray },
        Ray { t_min: 2.5, ..ray },
        Ray { t_min: 2.5, t_max: 2.9, ..ray },
        Ray { exclude_primitive: 0, ..ray },
        Ray { exclude_primitive: 0, t_max: 2.5, ..ray },
        Ray { exclude_primitive: 1, t_min: 2.5, ..ray },
        Ray { t_min: 4.5, ..ray },
        Ray { direction: [f32::NAN, 0.0, 1.0], ..ray },
        Ray { direction: [0.0; 3], ..ray },
        Ray { origin: [f32::INFINITY, 0.0, 0.0], ..ray },
        Ray { t_max: -1.0, ..ray },
    ];
    let expected =
        [Some(0), None, Some(0), Some(1), None, Some(1), None, Some(2), None, None, None, None, None];
    let hits = bench.trace(&structure, &rays).hits;
    let occluded = bench.occluded(&structure, &rays);
    for (index, hit) in hits.iter().enumerate() {
        assert_eq!(hit.is_hit().then_some(hit.primitive), expected[index], "{:?}", rays[index]);
        assert_eq!(occluded[index], expected[index].is_some(), "{:?}", rays[index]);
    }
}

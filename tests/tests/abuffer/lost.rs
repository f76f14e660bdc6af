//! Triangles that cover no cell's centre are counted, and with conservative coverage found.

use std::collections::HashSet;

use rasray_abuffer::{ABuffer, Builder, Config, Coverage, March, Storage, Views, cell_count, well_formed};
use rasray_ads::{BruteForce, Hit, Ray, Structure, StructureKind, Viewpoint};
use rasray_gpu::Timing;
use rasray_shaders_glsl::constants::ads::{CONSERVATIVE_LONG, CONSERVATIVE_LONGEST, CONSERVATIVE_SLICES};
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::rays::towards;
use rasray_tests::shapes::{Triangle, closed_box};
use rasray_tests::tier::is_full;
use rasray_tests::views::LEANING;
use rasray_tracer::build_until_complete;

const EYE: [f32; 3] = [0.1, -0.2, 0.3];

/// Triangles in planes through the eye, and small ones all around.
const WITH_AREA: u32 = 660;

/// Those, and some without an area.
fn scene() -> Vec<Triangle> {
    let mut random = Random::new(41);
    let mut triangles = Vec::new();
    for _ in 0..60 {
        // Corners that are combinations of two directions lie in one plane with the eye except for rounding.
        let (u, v) = (random.direction(), random.direction());
        let mut corner = || {
            let (s, t) = (random.between(1.0, 4.0), random.between(1.0, 4.0));
            std::array::from_fn(|axis| EYE[axis] + s * u[axis] + t * v[axis])
        };
        triangles.push([corner(), corner(), corner()]);
    }
    for index in 0..600 {
        let middle = random.point(-6.0, 6.0);
        let size = [0.02, 0.1, 0.6][index % 3];
        triangles.push(random.triangle(middle, size));
    }
    for _ in 0..20 {
        triangles.push([random.point(-5.0, 5.0); 3]);
    }
    triangles
}

fn built(bench: &Bench, config: Config, triangles: &[Triangle]) -> ABuffer {
    let geometry = bench.geometry(triangles);
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    build_until_complete(bench.device(), &mut structure, EYE, Timing::None).expect("the build completes");
    structure
}

/// The count is that of the triangles without a fragment, whatever the coverage and the storage.
#[test]
fn triangles_without_a_fragment_are_counted() {
    let bench = Bench::new();
    let triangles = scene();
    let robust = Config { views: Views::Cube, ..Config::at_centres(32) };
    let mut counts = Vec::new();
    for config in [
        robust,
        Config { storage: Storage::Sb, ..robust },
        Config { coverage: Coverage::Hardware, storage: Storage::Ll, ..robust },
        Config { resolution: 128, ..robust },
    ] {
        let structure = built(&bench, config, &triangles);
        let contents = structure.download(bench.device()).expect("the device works");
        let named: HashSet<u32> = contents.data[..contents.header.demand as usize].iter().copied().collect();
        let unnamed = (0..WITH_AREA).filter(|primitive| !named.contains(primitive)).count() as u64;
        assert_eq!(structure.report().expect("the header is readable").lost, Some(unnamed), "{config:?}");
        counts.push(unnamed);
    }
    println!("{counts:?} of {WITH_AREA} triangles cover no centre");
    assert!(counts[0] > 200 && counts[3] < counts[0] && counts[3] >= 50, "{counts:?}");
    assert_eq!(counts[0], counts[1]);
}

/// Rays from anywhere to points of the triangles.
fn rays(triangles: &[Triangle]) -> Vec<Ray> {
    let mut random = Random::new(42);
    let mut rays = Vec::new();
    for triangle in &triangles[..WITH_AREA as usize] {
        for _ in 0..10 {
            let origin = random.point(-6.0, 6.0);
            let [w, u, v] = random.weights();
            let [a, b, c] = triangle;
            let target = std::array::from_fn(|axis| w * a[axis] + u * b[axis] + v * c[axis]);
            rays.push(towards(origin, target));
        }
    }
    rays
}

/// The shares of rays answered right: of those that hit triangles without a fragment, and of all others.
fn right_shares(named: &HashSet<u32>, hits: &[Hit], expected: &[Hit]) -> [f64; 2] {
    let mut counts = [[0_u32; 2]; 2];
    for (hit, expected) in hits.iter().zip(expected).filter(|(_, expected)| expected.is_hit()) {
        let count = &mut counts[usize::from(named.contains(&expected.primitive))];
        count[0] += u32::from((hit.t - expected.t).abs() <= 1.0e-4 * expected.t);
        count[1] += 1;
    }
    counts.map(|[right, all]| f64::from(right) / f64::from(all))
}

/// With all triangles kept in every cell that they reach into, hits are those of brute force, bit for bit;
/// exact coverage loses nearly all triangles without a fragment.
#[test]
fn conservative_coverage_finds_what_brute_force_finds() {
    let bench = Bench::new();
    let triangles = scene();
    let (geometry, rays) = (bench.geometry(&triangles), rays(&triangles));
    let brute = BruteForce::new(bench.device(), &geometry, None, false).expect("pipelines can be made");
    let (expected, occluded) = (bench.trace(&brute, &rays).hits, bench.occluded(&brute, &rays));
    for resolution in [1, 16, 32, 128] {
        let conservative = Config { coverage: Coverage::Conservative, ..Config::at_centres(resolution) };
        let kept = built(&bench, conservative, &triangles);
        assert_eq!(kept.description().kind, StructureKind::Primitive);
        assert_eq!(kept.report().expect("the header is readable").lost, Some(0));
        let hits = bench.trace(&kept, &rays).hits;
        let wrong = hits.iter().zip(&expected).filter(|(hit, expected)| bits(hit) != bits(expected)).count();
        assert_eq!(wrong, 0, "{resolution} cells, of {} rays", rays.len());
        assert_eq!(bench.occluded(&kept, &rays), occluded, "{resolution} cells");
        if resolution < 32 {
            continue;
        }
        let exact = built(&bench, Config::at_centres(resolution), &triangles);
        assert_eq!(exact.description().kind, StructureKind::Fragment);
        let contents = exact.download(bench.device()).expect("the device works");
        let named: HashSet<u32> = contents.data[..contents.header.demand as usize].iter().copied().collect();
        let shares = right_shares(&named, &bench.trace(&exact, &rays).hits, &expected);
        println!(
            "{resolution} cells, right of lost and of stored triangles without conservative lists: {shares:?}"
        );
        assert!(shares[0] < 0.3, "{shares:?}");
    }
}

/// Lost triangles and those seen edge-on go to conservative lists: nothing is lost then, triangles without a
/// fragment are found like others, and conservative lists hold far fewer than with conservative coverage.
#[test]
fn edge_on_triangles_are_found() {
    let bench = Bench::new();
    let triangles = scene();
    let (geometry, rays) = (bench.geometry(&triangles), rays(&triangles));
    let brute = BruteForce::new(bench.device(), &geometry, None, false).expect("pipelines can be made");
    let expected = bench.trace(&brute, &rays).hits;
    for resolution in [1, 32, 128] {
        let exact = Config::at_centres(resolution);
        let made = |coverage| built(&bench, Config { coverage, ..exact }, &triangles);
        let [without, with, all] = [Coverage::Exact, Coverage::EdgeOn, Coverage::Conservative].map(made);
        assert_eq!(with.description().kind, StructureKind::Fragment);
        let reports = [&without, &with, &all].map(|structure| {
            let report = structure.report().expect("the header is readable");
            assert_eq!(report.formula_bytes, report.bytes() - report.slack(), "{resolution} cells");
            report
        });
        assert_eq!([reports[1].lost, reports[2].lost], [Some(0), Some(0)], "{resolution} cells");
        let contents = with.download(bench.device()).expect("the device works");
        well_formed(&contents).expect("lists are well formed");
        let named: HashSet<u32> = contents.data[..contents.header.demand as usize].iter().copied().collect();
        let nearby: HashSet<u32> = (0..cell_count(&contents.config) as usize)
            .flat_map(|cell| contents.conservative_list_of(cell).expect("links are sound"))
            .collect();
        let unnamed: HashSet<u32> = (0..WITH_AREA).filter(|primitive| !named.contains(primitive)).collect();
        assert!(
            unnamed.is_subset(&nearby),
            "{resolution} cells: {:?}",
            unnamed.difference(&nearby).take(5).map(|p| triangles[*p as usize]).collect::<Vec<_>>()
        );
        let conservative_lists =
            [&with, &all].map(|structure| structure.header().expect("it is readable").conservative_demand);
        let shares = [&without, &with]
            .map(|structure| right_shares(&named, &bench.trace(structure, &rays).hits, &expected));
        println!(
            "{resolution} cells: {conservative_lists:?} in conservative lists, right of lost and of stored triangles {shares:?}"
        );
        if resolution == 1 {
            // Every plane represents a whole face.
            continue;
        }
        assert!(
            10 * conservative_lists[0] < 9 * conservative_lists[1],
            "{resolution} cells: {conservative_lists:?}"
        );
        assert!(shares[0][0] < 0.3 && shares[1][0] > 0.8, "{resolution} cells: {shares:?}");
        assert!(shares[1][1] >= shares[0][1], "{resolution} cells: {shares:?}");
    }
}

/// Nor do they change a hit where the conservative list holds only lost triangles, with either builder.
#[test]
fn conservative_lists_of_what_is_lost_are_searched_to_their_end() {
    let bench = Bench::new();
    let mut triangles = scene();
    triangles.extend(closed_box([-90.0; 3], [90.0; 3]));
    let (geometry, rays) = (bench.geometry(&triangles), rays(&triangles));
    let edge_on = Config { coverage: Coverage::EdgeOn, ..Config::at_centres(32) };
    // Those of the quick tier come first: every value, not each storage.
    let mut configs = vec![
        edge_on,
        Config { work_budget: Some(3), ..edge_on },
        Config { storage: Storage::Paged, sort: false, skip: false, ..edge_on },
        Config { builder: Builder::Binning, march: March::Pyramid, storage: Storage::Sb, ..edge_on },
    ];
    if is_full() {
        configs.extend(Storage::ALL.map(|storage| Config { storage, ..edge_on }));
        configs.push(Config { builder: Builder::Binning, march: March::Pyramid, ..edge_on });
        configs.push(Config { builder: Builder::Binning, storage: Storage::Sb, ..edge_on });
        configs.push(Config { march: March::Pyramid, storage: Storage::Sb, ..edge_on });
        configs.push(Config { sort: false, skip: false, ..edge_on });
    }
    let mut expected: Option<Vec<_>> = None;
    for config in configs {
        let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("valid");
        let found: Vec<_> = bench.build_and_trace(&mut structure, EYE, &rays).iter().map(bits).collect();
        assert!(expected.get_or_insert_with(|| found.clone()) == &found, "{config:?}");
    }
}

/// Neither storage nor views nor skips nor pauses change a hit from that of brute force, and small budgets
/// end within long conservative lists.
#[test]
fn conservative_lists_are_searched_to_their_end() {
    let bench = Bench::new();
    let mut triangles = scene();
    // All of it within a cell or two next to a large room.
    triangles.extend(closed_box([-90.0; 3], [90.0; 3]));
    let small: Vec<Triangle> = scene()[60..]
        .iter()
        .map(|triangle| triangle.map(|p| std::array::from_fn(|axis| 40.0 + 0.05 * p[axis])))
        .collect();
    triangles.extend(small);
    let geometry = bench.geometry(&triangles);
    let mut rays = rays(&triangles);
    let mut random = Random::new(43);
    rays.extend((0..2000).map(|_| {
        let (origin, target) = (random.point(-20.0, 20.0), random.near([40.0; 3], 0.2));
        towards(origin, target)
    }));
    let brute = BruteForce::new(bench.device(), &geometry, None, false).expect("pipelines can be made");
    let expected: Vec<_> = bench.trace(&brute, &rays).hits.iter().map(bits).collect();
    let conservative = Config { coverage: Coverage::Conservative, ..Config::at_centres(32) };
    let with_camera = Config { views: Views::CubeCamera, camera_resolution: [21, 12], ..conservative };
    // Those of the quick tier come first: every value, not each storage.
    let mut configs = vec![
        Config { work_budget: Some(3), ..conservative },
        Config { work_budget: Some(17), march: March::Pyramid, ..conservative },
        Config { storage: Storage::Paged, sort: false, skip: false, ..conservative },
        Config { march: March::Pyramid, storage: Storage::Sb, ..with_camera },
        Config { builder: Builder::Binning, camera_resolution: [30, 7], ..with_camera },
    ];
    if is_full() {
        configs.extend(Storage::ALL.map(|storage| Config { storage, ..conservative }));
        configs.push(Config { march: March::Pyramid, ..conservative });
        configs.push(Config { march: March::Pyramid, storage: Storage::Sb, ..conservative });
        configs.push(Config { sort: false, skip: false, ..conservative });
        configs.push(with_camera);
        configs.push(Config { resolution: 13, camera_resolution: [5, 40], ..with_camera });
    }
    for config in configs {
        let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("valid");
        let viewpoint = Viewpoint { eye: EYE, camera: config.views.has_camera().then_some(LEANING) };
        let found: Vec<_> =
            bench.build_and_trace(&mut structure, viewpoint, &rays).iter().map(bits).collect();
        let different = (0..found.len()).filter(|&ray| found[ray] != expected[ray]).count();
        assert_eq!(different, 0, "{config:?}");
    }
}

/// More triangles than there are marks for make the build incomplete, and marks grow.
#[test]
fn marks_grow_with_the_geometry() {
    let bench = Bench::new();
    let mut structure = built(&bench, Config::at_centres(32), &closed_box([-10.0; 3], [10.0; 3]));
    assert_eq!(structure.report().expect("the header is readable").lost, Some(0));
    let triangles = scene();
    structure.set_geometry(bench.device(), &bench.geometry(&triangles)).expect("it fits");
    build_until_complete(bench.device(), &mut structure, EYE, Timing::None).expect("it grows");
    let report = structure.report().expect("the header is readable");
    assert!(report.lost > Some(200), "{report:?}");
    let slack = report.bytes_by_part.iter().find(|part| part.0 == "slack").expect("the part exists").1;
    assert_eq!(report.formula_bytes, report.bytes() - slack);
}

/// Conservative lists that are shorter than those that are divided, long ones, and one that is too long: hits
/// are those of brute force, for rays that pause too.
#[test]
fn long_conservative_lists_are_divided_by_depth() {
    let bench = Bench::new();
    let mut random = Random::new(43);
    for count in [CONSERVATIVE_LONG - 1, 40 * CONSERVATIVE_LONG, CONSERVATIVE_LONGEST + 1] {
        // In the cell at +z between x/z, y/z of 0 and 1, away from its centre.
        let triangles: Vec<Triangle> = (0..count)
            .map(|_| {
                let depth = random.between(1.0, 20.0);
                let [x, y] = [0; 2].map(|_| depth * random.between(0.65, 0.85));
                random.triangle([EYE[0] + x, EYE[1] + y, EYE[2] + depth], 0.04 * depth)
            })
            .collect();
        let rays: Vec<Ray> = (0..400)
            .map(|index| {
                let [a, b, _] = triangles[index * 7 % triangles.len()];
                let middle = std::array::from_fn(|axis| 0.5 * a[axis] + 0.5 * b[axis]);
                let origin = if index % 2 == 0 { EYE } else { random.point(-1.0, 20.0) };
                towards(origin, middle)
            })
            .collect();
        let geometry = bench.geometry(&triangles);
        let brute = BruteForce::new(bench.device(), &geometry, None, false).expect("pipelines can be made");
        let expected = bench.trace(&brute, &rays).hits;
        for work_budget in [None, Some(500)] {
            let config = Config { work_budget, ..Config::robust(2) };
            let structure = built(&bench, config, &triangles);
            let contents = structure.download(bench.device()).expect("the device works");
            well_formed(&contents).expect("lists are well formed");
            assert!(contents.header.conservative_demand >= count);
            let slices = contents.header.conservative_slices;
            let lengths = (0..cell_count(&contents.config) as usize)
                .map(|cell| contents.conservative_list_of(cell).expect("links are sound").len() as u32);
            assert_eq!(lengths.clone().max(), Some(count), "one cell has all triangles");
            let divided =
                lengths.filter(|length| (CONSERVATIVE_LONG..=CONSERVATIVE_LONGEST).contains(length));
            assert_eq!(slices, CONSERVATIVE_SLICES * divided.count() as u32, "{count} triangles");
            let report = structure.report().expect("the header is readable");
            assert_eq!(report.formula_bytes, report.bytes() - report.slack(), "{count} triangles");
            let hits = bench.trace(&structure, &rays).hits;
            for (ray, (hit, expected)) in hits.iter().zip(&expected).enumerate() {
                assert_eq!(bits(hit), bits(expected), "{count} triangles, budget {work_budget:?}, ray {ray}");
            }
        }
    }
}

//! Triangles that cover no cell's centre are counted.

use std::collections::HashSet;

use rasray_abuffer::{ABuffer, Config, Coverage, Storage, Views};
use rasray_ads::Structure;
use rasray_gpu::Timing;
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, closed_box};
use rasray_tracer::build_until_complete;

const EYE: [f32; 3] = [0.1, -0.2, 0.3];

/// Triangles in planes through the eye, and small ones all around.
const WITH_AREA: u32 = 660;

/// Those, and some without an area.
fn scene() -> Vec<Triangle> {
    let mut random = Random::new(41);
    let mut triangles = Vec::new();
    for _ in 0..60 {
        // Corners that are combinations of two directions lie in one plane with the eye but for rounding.
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
        let mut corner = || {
            let offset = random.point(-size, size);
            std::array::from_fn(|axis| middle[axis] + offset[axis])
        };
        triangles.push([corner(), corner(), corner()]);
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

/// The count is that of the triangles that no fragment names, whoever decides coverage and however fragments are kept.
#[test]
fn triangles_without_a_fragment_are_counted() {
    let bench = Bench::new();
    let triangles = scene();
    let robust = Config { views: Views::Cube, ..Config::robust(32) };
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

/// More triangles than there are marks for are no answer, but a reason to grow.
#[test]
fn marks_grow_with_the_geometry() {
    let bench = Bench::new();
    let mut structure = built(&bench, Config::robust(32), &closed_box([-10.0; 3], [10.0; 3]));
    assert_eq!(structure.report().expect("the header is readable").lost, Some(0));
    let triangles = scene();
    structure.set_geometry(bench.device(), &bench.geometry(&triangles)).expect("it fits");
    build_until_complete(bench.device(), &mut structure, EYE, Timing::None).expect("it grows");
    let report = structure.report().expect("the header is readable");
    assert!(report.lost > Some(200), "{report:?}");
    let slack = report.bytes_by_part.iter().find(|part| part.0 == "slack").expect("the part exists").1;
    assert_eq!(report.formula_bytes, report.bytes() - slack);
}

//! Depth bounds of cells from boxes around objects: they enclose every fragment, and no hit changes.

use rasray_abuffer::{
    ABuffer, Accept, Addressing, Bounds, Config, Contents, Coverage, March, Storage, Views, cell_count,
    well_formed,
};
use rasray_ads::{Ray, Structure, Viewpoint};
use rasray_gpu::Timing;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, all_sizes};
use rasray_tests::tier::first;
use rasray_tests::views::TURNED;
use rasray_tracer::build_until_complete;

/// Objects around the eyes below and beside them: large and small ones, some flat, fans of slivers that are
/// seen edge-on from the origin, one without triangles.
fn objects() -> Vec<Vec<Triangle>> {
    let mut random = Random::new(0x626f_7865);
    let mut objects = vec![all_sizes(), Vec::new()];
    for index in 0..40 {
        let (centre, size) = (random.point(-7.0, 7.0), if index % 5 == 0 { 2.0 } else { 0.3 });
        let mut corner = || {
            let offset = random.point(-size, size);
            let flat = if index % 3 == 0 { 0.0 } else { offset[2] };
            [centre[0] + offset[0], centre[1] + offset[1], centre[2] + flat]
        };
        objects.push((0..6).map(|_| [corner(), corner(), corner()]).collect());
    }
    let along = |p: [f32; 3], share: f32| p.map(|x| x * share);
    for _ in 0..12 {
        let (p, q) = (random.point(-4.0, 4.0), random.point(-4.0, 4.0));
        objects.push(vec![[p, along(p, 1.7), q], [q, along(q, 0.4), along(p, 1.3)]]);
    }
    objects
}

struct Built {
    contents: Contents,
    hits: Vec<[u32; 4]>,
}

fn built(bench: &Bench, config: Config, objects: &[Vec<Triangle>], eye: [f32; 3], rays: &[Ray]) -> Built {
    let draws: Vec<&[Triangle]> = objects.iter().map(Vec::as_slice).collect();
    let geometry = bench.geometry_of_draws(&draws);
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    let viewpoint = Viewpoint { eye, camera: config.views.has_camera().then_some(TURNED) };
    build_until_complete(bench.device(), &mut structure, viewpoint, Timing::None).expect("it completes");
    assert_eq!(structure.status(0).expect("the status is readable").corrupted, 0, "{config:?}");
    let report = structure.report().expect("the header is readable");
    assert_eq!(report.bytes() - report.slack(), report.formula_bytes, "{config:?}");
    // The place of a fragment in the pool is not part of a hit.
    let place = !config.accept.needs_triangles();
    let key =
        |[t, primitive, a, b]: [u32; 4]| if place { [t, primitive, 0, 0] } else { [t, primitive, a, b] };
    let hits = bench.trace(&structure, rays).hits.iter().map(bits).map(key).collect();
    let contents = structure.download(bench.device()).expect("the device works");
    // Every depth lies within the bounds of its cell.
    well_formed(&contents).expect("lists are well formed");
    Built { contents, hits }
}

/// Depth and triangle of the fragments of each cell, in one order whatever the buckets.
fn fragments(contents: &Contents) -> Vec<Vec<(u32, u32)>> {
    let cells = contents.fragments().expect("lists are well formed");
    let sorted = |cell: &Vec<rasray_abuffer::Fragment<'_>>| {
        let mut keys: Vec<_> =
            cell.iter().map(|fragment| (fragment.z.to_bits(), fragment.payload[0])).collect();
        keys.sort_unstable();
        keys
    };
    cells.iter().map(sorted).collect()
}

/// Builds with bounds of both kinds. A fragment outside of its cell's bounds would be counted as corrupted
/// and not be stored, so where depths are equal boxes enclose them.
fn compare(bench: &Bench, config: Config, objects: &[Vec<Triangle>], eye: [f32; 3], rays: &[Ray]) {
    let [geometry, boxes] =
        Bounds::ALL.map(|bounds| built(bench, Config { bounds, ..config }, objects, eye, rays));
    let name = format!("{config:?}, eye {eye:?}");
    let stored = fragments(&geometry.contents);
    assert!(stored.iter().map(Vec::len).sum::<usize>() > 500, "{name}: too little to compare");
    assert!(stored == fragments(&boxes.contents), "{name}: other fragments");
    assert_eq!(geometry.contents.header.lost, boxes.contents.header.lost, "{name}");
    let cells = cell_count(&config) as usize;
    let narrow = geometry.contents.bounds[..cells] == boxes.contents.bounds[..cells];
    assert!(!narrow, "{name}: boxes are as narrow as fragments");
    assert!(geometry.hits == boxes.hits, "{name}: other hits");
    let hit = geometry.hits.iter().filter(|hit| hit[1] != u32::MAX).count();
    assert!(hit > 50 || config.views == Views::Camera, "{name}: {hit} hits");
}

#[test]
fn boxes_enclose_every_fragment_and_change_no_hit() {
    let bench = Bench::new();
    let (objects, rays) = (objects(), Random::new(0x7261).rays(1500, -3.0, 3.0));
    let tried = [
        (Storage::Dllb, Coverage::Exact, Accept::Interval, Views::CubeCamera, March::Exact),
        (Storage::Llb, Coverage::Conservative, Accept::Plane, Views::Cube, March::Pyramid),
        (Storage::Paged, Coverage::EdgeOn, Accept::Plane, Views::Camera, March::Pyramid),
        (Storage::Paged, Coverage::Exact, Accept::Slope, Views::Cube, March::Samples),
    ];
    for (index, &(storage, coverage, accept, views, march)) in first(&tried, 2).iter().enumerate() {
        let addressing = if index % 2 == 0 { Addressing::Descriptor } else { Addressing::Address };
        let config = Config {
            storage,
            coverage,
            accept,
            views,
            march,
            addressing,
            camera_resolution: [40, 21],
            ..Config::at_centres(31)
        };
        // Within boxes and planes; beside everything, which the camera looks at.
        for eye in [[0.0; 3], [-1.9, -9.3, -10.3]] {
            compare(&bench, config, &objects, eye, &rays);
        }
    }
    // More draws than there is room for boxes: two in a row share one.
    let mut random = Random::new(0x6d61_6e79);
    let mut triangle = || -> Triangle {
        let centre = random.point(-6.0, 6.0);
        random.triangle(centre, 0.4)
    };
    let many: Vec<Vec<Triangle>> = (0..4_200).map(|_| vec![triangle()]).collect();
    let config = Config {
        accept: Accept::Interval,
        views: Views::CubeCamera,
        camera_resolution: [40, 21],
        ..Config::at_centres(31)
    };
    compare(&bench, config, &many, [0.0; 3], &rays);
}

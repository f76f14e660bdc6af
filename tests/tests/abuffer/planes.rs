//! The payload of planes: the plane of the fragment's triangle is stored, rays hit it as they would hit that
//! of the triangle, and no ray reads the triangle.

use rasray_abuffer::{
    ABuffer, Accept, Addressing, Builder, Config, Coverage, Fragment, March, Payload, Storage, well_formed,
};
use rasray_ads::{Hit, PRIMITIVE_UNKNOWN, Ray, Structure, TraceMode};
use rasray_gpu::Timing;
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, all_sizes, closed_box, sphere};
use rasray_tracer::build_until_complete;

const EYE: [f32; 3] = [0.3, -0.7, 0.2];

fn planes(resolution: u32) -> Config {
    Config { payload: Payload::Plane, ..Config::at_centres(resolution) }
}

fn built(bench: &Bench, config: Config, triangles: &[Triangle]) -> ABuffer {
    let geometry = bench.geometry(triangles);
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    build_until_complete(bench.device(), &mut structure, EYE, Timing::None).expect("the build completes");
    let report = structure.report().expect("the header is readable");
    assert_eq!(report.bytes() - report.slack(), report.formula_bytes, "{config:?}");
    structure
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| a[axis] * b[axis]).sum()
}

/// Unit normal, distance from the eye, and how far rounding to floats may turn the normal.
fn exact_plane(triangle: &Triangle) -> ([f64; 3], f64, f64) {
    let [a, b, c] = triangle.map(|corner| corner.map(f64::from));
    let (ab, ac) = (sub(b, a), sub(c, a));
    let product = |i: usize, j: usize| (ab[i] * ac[j], ab[j] * ac[i]);
    let terms = [product(1, 2), product(2, 0), product(0, 1)];
    let normal = terms.map(|(along, against)| along - against);
    let length = dot(normal, normal).sqrt();
    let largest =
        terms.iter().fold(0.0_f64, |largest, (along, against)| largest.max(along.abs() + against.abs()));
    let unit = normal.map(|x| x / length);
    (unit, dot(unit, sub(a, EYE.map(f64::from))), 6.0e-7 * largest / length + 6.0e-7)
}

#[test]
fn stored_planes_are_those_of_the_triangles() {
    let bench = Bench::new();
    let triangles = all_sizes();
    for (storage, builder) in Storage::ALL.into_iter().zip(Builder::ALL.into_iter().cycle()) {
        let [named, stored] = [Payload::Index, Payload::Plane].map(|payload| {
            let config = Config { payload, storage, builder, inline: true, ..Config::at_centres(32) };
            let structure = built(&bench, config, &triangles);
            let contents = structure.download(bench.device()).expect("the device works");
            well_formed(&contents).unwrap_or_else(|fault| panic!("{config:?}: {fault}"));
            contents
        });
        let (named, stored) =
            (named.fragments().expect("well formed"), stored.fragments().expect("well formed"));
        let mut checked = 0;
        for (named, stored) in named.iter().zip(&stored) {
            assert_eq!(named.len(), stored.len());
            for Fragment { z, payload: words } in stored {
                let normal = [words[0], words[1], words[2]].map(|word| f64::from(f32::from_bits(word)));
                let offset = f64::from(f32::from_bits(words[3]));
                let length = dot(normal, normal).sqrt();
                assert!((length - 1.0).abs() < 1.0e-6, "length {length}");
                // It is the plane of one of the cell's triangles at that depth. Around the fragment it is
                // close, so its distance from the eye is off by as much as the normal is turned over the way
                // to the fragment.
                let is_plane_of = |primitive: u32| {
                    let (unit, distance, turn) = exact_plane(&triangles[primitive as usize]);
                    let turned = (0..3).fold(0.0_f64, |far, axis| far.max((unit[axis] - normal[axis]).abs()));
                    turned <= turn && (offset - distance).abs() <= 3.0 * f64::from(*z) * turn + 1.0e-5
                };
                let known = named.iter().filter(|fragment| fragment.z.to_bits() == z.to_bits());
                assert!(
                    known.map(|fragment| fragment.payload[0]).any(is_plane_of),
                    "{storage:?}: {normal:?} {offset} at {z}"
                );
                checked += 1;
            }
        }
        assert!(checked > 5000, "{storage:?}: {checked} fragments");
    }
}

/// Where rays hit a plane with the payload `index`, they hit the stored one, except where a plane ends beyond
/// its triangle.
#[test]
fn stored_planes_are_met_where_those_of_triangles_are() {
    let bench = Bench::new();
    let mut triangles: Vec<Triangle> = closed_box([-10.0; 3], [10.0; 3]).to_vec();
    triangles.extend(sphere([-3.0, 0.5, -2.0], 1.5, 10));
    let rays = Random::new(0x706c).rays(4000, -6.0, 6.0);
    let named = bench.trace(&built(&bench, Config::at_centres(128), &triangles), &rays).hits;
    let stored = bench.trace(&built(&bench, planes(128), &triangles), &rays).hits;
    let agrees = |named: &Hit, stored: &Hit| match (named.is_hit(), stored.is_hit()) {
        (true, true) => (named.t - stored.t).abs() <= 2.0e-6 * named.t.max(1.0),
        (named, stored) => named == stored,
    };
    let same = named.iter().zip(&stored).filter(|(named, stored)| agrees(named, stored)).count();
    println!("{same} of {} rays hit the same point", rays.len());
    assert!(same >= rays.len() * 995 / 1000, "{same} of {} rays hit the same point", rays.len());
    assert!(stored.iter().all(|hit| !hit.is_hit() || hit.primitive == PRIMITIVE_UNKNOWN));
}

fn keys(hits: &[Hit]) -> Vec<(u32, u32)> {
    hits.iter().map(|hit| (hit.t.to_bits(), hit.primitive)).collect()
}

#[test]
fn storages_and_builders_change_no_hit() {
    let bench = Bench::new();
    let (triangles, rays) = (all_sizes(), Random::new(0x706c).rays(1500, -6.0, 6.0));
    let first = planes(32);
    let expected = keys(&bench.trace(&built(&bench, first, &triangles), &rays).hits);
    assert!(expected.iter().filter(|key| key.1 == PRIMITIVE_UNKNOWN).count() > rays.len() / 2);
    for (index, storage) in Storage::ALL.into_iter().enumerate() {
        let config = Config {
            storage,
            builder: Builder::ALL[index % 2],
            inline: index % 3 == 0,
            sort: index != 4,
            skip: index != 2,
            march: if index == 3 { March::Pyramid } else { March::Exact },
            addressing: if index == 1 { Addressing::Address } else { Addressing::Descriptor },
            work_budget: (index >= 3).then_some(16),
            ..first
        };
        let structure = built(&bench, config, &triangles);
        let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, TraceMode::Closest, 400);
        assert_eq!((counters.unfinished, counters.not_ready), (0, 0), "{config:?}");
        assert!(keys(&hits) == expected, "{config:?}");
    }
}

/// Planes that intersect in a line through the centres of cells: one depth, one t, and the same first words.
fn crossing(reversed: bool) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    for layer in 0..6 {
        let (z, slope) = (4.0 + layer as f32, 0.25);
        let corner = |x: f32, y: f32, slope: f32| [EYE[0] + x, EYE[1] + y, EYE[2] + z + slope * y];
        // Wound so that the normals of both begin with the same zero.
        triangles.push([corner(-8.0, -2.0, slope), corner(8.0, -2.0, slope), corner(0.0, 4.0, slope)]);
        triangles.push([corner(-8.0, -2.0, -slope), corner(0.0, 4.0, -slope), corner(8.0, -2.0, -slope)]);
    }
    if reversed {
        triangles.reverse();
    }
    triangles
}

/// Rays hit the same one of planes at one t, however lists are kept and in whatever order triangles come.
#[test]
fn ties_are_broken_by_all_words() {
    const SIDE: u32 = 33;
    let bench = Bench::new();
    let center = |cell: u32| (2 * cell + 1) as f32 / SIDE as f32 - 1.0;
    // Through the centres of the middle row.
    let rays: Vec<Ray> = (8..25).map(|x| Ray::new(EYE, [center(x), 0.0, 1.0])).collect();
    let mut expected: Option<Vec<Vec<u32>>> = None;
    for (index, storage) in Storage::ALL.into_iter().enumerate() {
        for reversed in [false, true] {
            let config = Config { storage, sort: index != 1, inline: index == 3, ..planes(SIDE) };
            let structure = built(&bench, config, &crossing(reversed));
            let contents = structure.download(bench.device()).expect("the device works");
            well_formed(&contents).unwrap_or_else(|fault| panic!("{config:?}: {fault}"));
            let cells = contents.fragments().expect("well formed");
            let is_tie = |fragments: &[Fragment<'_>]| {
                let tied = |left: &Fragment<'_>, right: &Fragment<'_>| {
                    left.z == right.z
                        && left.payload[..2] == right.payload[..2]
                        && left.payload != right.payload
                };
                fragments.iter().any(|left| fragments.iter().any(|right| tied(left, right)))
            };
            let ties = cells.iter().filter(|fragments| is_tie(fragments)).count();
            assert!(ties >= rays.len(), "{storage:?}: {ties} cells with ties");
            let hits = bench.trace(&structure, &rays).hits;
            let found = hits.iter().map(|hit| {
                assert_eq!(hit.primitive, PRIMITIVE_UNKNOWN);
                contents.fragment(hit.a.to_bits()).expect("it is stored").payload.to_vec()
            });
            let found: Vec<_> = found.collect();
            assert_eq!(expected.get_or_insert_with(|| found.clone()), &found, "{storage:?}, {reversed}");
        }
    }
}

/// Once they are stored the triangles may go.
#[test]
fn rays_do_not_ask_for_triangles() {
    let bench = Bench::new();
    let triangles: Vec<Triangle> = closed_box([-10.0; 3], [10.0; 3]).to_vec();
    let rays = Random::new(0x706c).rays(500, -6.0, 6.0);
    for payload in [Payload::Plane, Payload::Index] {
        let geometry = bench.geometry(&triangles);
        let config = Config { payload, ..planes(32) };
        let mut structure =
            ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
        build_until_complete(bench.device(), &mut structure, EYE, Timing::None).expect("it completes");
        assert_eq!(structure.header().expect("it is readable").near_demand, 0);
        let before = keys(&bench.trace(&structure, &rays).hits);
        let nothing = vec![0.0_f32; 9 * triangles.len()];
        bench
            .device()
            .upload_slice(&geometry.desc().positions.buffer, 0, &nothing)
            .expect("the device works");
        let after = keys(&bench.trace(&structure, &rays).hits);
        assert_eq!(before == after, payload == Payload::Plane, "{payload:?}");
    }
}

#[test]
fn planes_exclude_what_asks_for_triangles() {
    let message = |config: Config| config.validate().expect_err("refused").to_string();
    let conservative = Config { coverage: Coverage::Conservative, ..planes(16) };
    assert!(message(conservative).contains("payload=index"));
    let slope = Config { accept: Accept::Slope, ..planes(16) };
    assert!(message(slope).contains("slope"));
    let normal = Config { payload: Payload::Normal, ..Config::at_centres(16) };
    assert!(message(normal).contains("accept"));
}

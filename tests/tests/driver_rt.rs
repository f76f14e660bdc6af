//! The driver's tree: what the host and the driver hold, rays that the driver cannot be asked about, and
//! hits. Whatever loops over the registry holds it to the demands of all structures.

use rasray_ads::{BruteForce, Geometry, Hit, Inspect, Ray, Structure};
use rasray_driver::{Config, Demand, Driver, Goal, plan};
use rasray_gpu::Timing;
use rasray_systems::Spec;
use rasray_tests::harness::{Bench, bits, is_offered};
use rasray_tests::random::Random;
use rasray_tests::rays::{along_axis, towards};
use rasray_tests::shapes::{Triangle, layers_and_sphere, sphere, with_twins};
use rasray_tracer::build_until_complete;

const RAYS: usize = 3000;

/// The device of the tests, where it has ray queries.
fn bench() -> Option<Bench> {
    let spec = Spec::new("driver-rt", "robust", []).expect("it is registered");
    is_offered(&spec).then(Bench::new)
}

/// Random rays, rays along axes and at corners of triangles, and rays that the driver is not asked about:
/// from far outside, of subnormal directions, and of no direction.
fn rays(triangles: &[Triangle]) -> Vec<Ray> {
    let mut random = Random::new(0x6472_6976);
    (0..RAYS)
        .map(|index| {
            let origin = random.point(-6.0, 6.0);
            let triangle = triangles[(random.bits() % triangles.len() as u64) as usize];
            let corner = triangle[index % 3];
            match index % 8 {
                0 => Ray::new(origin, along_axis(index / 8)),
                1 => towards(origin, corner),
                2 => Ray::new(corner, random.direction()),
                3 => towards(origin.map(|x| 1.0e4 * x), corner),
                4 => Ray::new(origin, random.direction().map(|x| x * 1.0e-39)),
                5 => Ray::new(
                    origin,
                    random.direction().map(|x| x * if index % 16 == 5 { 1.0e20 } else { 1.0e-20 }),
                ),
                6 => Ray { exclude_primitive: (index % triangles.len()) as u32, ..towards(origin, corner) },
                _ if index % 64 == 7 => Ray::new(origin, [0.0; 3]),
                _ => Ray { t_min: 0.5, t_max: 3.0, ..Ray::new(origin, random.direction()) },
            }
        })
        .collect()
}

fn brute_force(bench: &Bench, geometry: &Geometry, rays: &[Ray]) -> Vec<[u32; 4]> {
    let mut structure = BruteForce::new(bench.device(), geometry, None, false).expect("pipelines are made");
    bench.build_and_trace(&mut structure, [0.0; 3], rays).iter().map(bits).collect()
}

fn traced(bench: &Bench, structure: &mut Driver, rays: &[Ray]) -> Vec<[u32; 4]> {
    let hits = bench.build_and_trace(structure, [0.0; 3], rays);
    assert_eq!(structure.fault(bench.device()).expect("pools are read"), None);
    hits.iter().map(bits).collect()
}

#[test]
fn hits_are_those_of_brute_force() {
    let Some(bench) = bench() else { return };
    // The driver sees all of them at one size.
    for scale in [1.0, 1.0e-8, 1.0e8] {
        let triangles = with_twins(layers_and_sphere(16));
        let rays: Vec<Ray> = rays(&triangles)
            .into_iter()
            .map(|ray| Ray {
                origin: ray.origin.map(|x| x * scale),
                direction: ray.direction.map(|x| x * scale),
                ..ray
            })
            .collect();
        let triangles: Vec<Triangle> =
            triangles.iter().map(|triangle| triangle.map(|corner| corner.map(|x| x * scale))).collect();
        let geometry = bench.geometry(&triangles);
        let expected = brute_force(&bench, &geometry, &rays);
        let found = expected.iter().filter(|hit| hit[1] != u32::MAX).count();
        println!("{found} of {RAYS} rays hit something at {scale:e} metres per unit");
        assert!(found > RAYS / 3, "{found} hits are too few to compare");
        for goal in [Goal::Trace, Goal::Build] {
            let config = Config { goal, ..Config::new() };
            let mut structure =
                Driver::new(bench.device(), config, &geometry, None).expect("the options are valid");
            assert_eq!(traced(&bench, &mut structure, &rays), expected, "{} at {scale:e}", goal.name());
        }
    }
}

#[test]
fn boxes_grow_to_what_they_need_and_serve_fewer_triangles() {
    let Some(bench) = bench() else { return };
    let many = sphere([0.5, 0.25, 0.75], 2.0, 24);
    let geometry = bench.geometry(&many);
    let rays = rays(&many);
    let expected = brute_force(&bench, &geometry, &rays);
    let mut structure =
        Driver::new(bench.device(), Config::new(), &geometry, None).expect("the options are valid");
    let wanted = structure.sizes().clone();
    for boxes in [0, 1, many.len() as u64 / 2, many.len() as u64 - 1] {
        let few = plan(&Config::new(), &Demand { triangles: boxes }).expect("so few are valid");
        structure.resize(bench.device(), &few).expect("it fits");
        structure.prepare_build(bench.device()).expect("a tree of so few");
        let status = bench.build_once(&mut structure, [0.0; 3]);
        assert!(!status.complete, "{boxes} boxes");
        assert_eq!(status.demand("boxes"), Some(many.len() as u64));
        assert_eq!(traced(&bench, &mut structure, &rays), expected, "from {boxes} boxes");
        assert_eq!(structure.sizes(), &wanted);
    }
    // As many as are left in the pool are not built over.
    let few = sphere([-1.0, 0.0, 0.5], 1.0, 5);
    let smaller = bench.geometry(&few);
    structure.set_geometry(bench.device(), &smaller).expect("it fits");
    assert_eq!(traced(&bench, &mut structure, &rays), brute_force(&bench, &smaller, &rays));
    assert_eq!(structure.sizes(), &wanted);
    structure.set_geometry(bench.device(), &geometry).expect("it fits");
    assert_eq!(traced(&bench, &mut structure, &rays), expected);
}

#[test]
fn boxes_hold_their_triangles_and_reports_what_the_driver_took() {
    let Some(bench) = bench() else { return };
    let triangles = layers_and_sphere(12);
    let geometry = bench.geometry(&triangles);
    let mut structure =
        Driver::new(bench.device(), Config::new(), &geometry, None).expect("the options are valid");
    build_until_complete(bench.device(), &mut structure, [0.0; 3], Timing::None).expect("it is built");
    let contents = structure.download(bench.device()).expect("pools are read");
    let header = contents.header;
    assert!(header.scale.log2().fract() == 0.0 && (1.0..2.0).contains(&(header.scale * header.reach)));
    for (triangle, words) in triangles.iter().zip(contents.boxes.chunks_exact(6)) {
        let corners: Vec<f64> = words.iter().map(|word| f64::from(f32::from_bits(*word))).collect();
        for axis in 0..3 {
            let unit = f64::from(header.scale);
            let at = |corner: &[f32; 3]| (f64::from(corner[axis]) - f64::from(header.centre[axis])) * unit;
            let margin = 3.9 * f64::from(header.rounding) * unit;
            let inside = triangle
                .iter()
                .map(at)
                .all(|at| corners[axis] + margin <= at && at <= corners[axis + 3] - margin);
            assert!(inside && margin > 0.0, "{triangle:?} in {corners:?}");
        }
    }
    let report = structure.report().expect("it is read");
    let part =
        |wanted| report.bytes_by_part.iter().find(|(name, _)| *name == wanted).map(|(_, bytes)| *bytes);
    assert_eq!(part("boxes"), Some(24 * triangles.len() as u64));
    assert_eq!(part("header").zip(part("boxes")).map(|(a, b)| a + b), Some(report.formula_bytes));
    assert!(part("tree") > part("boxes") && part("tree scratch") > Some(0), "{:?}", report.bytes_by_part);
    // Without a ray that hits, nothing of the above says that hits are right.
    let hit: Hit = bench.trace(&structure, &[towards([0.0; 3], triangles[0][0])]).hits[0];
    assert!(hit.is_hit());
}

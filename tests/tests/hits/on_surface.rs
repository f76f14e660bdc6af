//! Rays that start on a surface and exclude nothing, as tools that know no triangle ids make them: origins
//! uniform over the area and rounded to f32, directions uniform, t_min 0.

use rasray_ads::{Ray, StructureKind};
use rasray_metrics::{DeviceHit, HitConfusion};
use rasray_tests::harness::{Bench, oracle_of, oracle_ray};
use rasray_tests::invariance::Subject;
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, sphere};
use rasray_tests::tier::Counts;

const RAYS: Counts<usize> = Counts { quick: 5000, software: 100_000, full: 1_000_000 };

/// Maximum number of triangles for brute force: each costs every ray a test.
const BRUTE_FORCE: usize = 10_000;

fn on(triangles: &[Triangle], count: usize) -> Vec<Ray> {
    let mut random = Random::new(0x0073_7572_6661_6365);
    let mut areas = Vec::with_capacity(triangles.len());
    let mut total = 0.0;
    for triangle in triangles {
        let [a, b, c] = triangle.map(|corner| glam::DVec3::from(corner.map(f64::from)));
        total += (b - a).cross(c - a).length();
        areas.push(total);
    }
    (0..count)
        .map(|_| {
            let share = f64::from(random.between(0.0, 1.0)) * total;
            let triangle = triangles[areas.partition_point(|area| *area < share).min(triangles.len() - 1)];
            let weights = random.weights();
            let origin = std::array::from_fn(|axis| {
                let terms = triangle.iter().zip(weights).map(|(p, w)| f64::from(p[axis]) * f64::from(w));
                terms.sum::<f64>() as f32
            });
            Ray::new(origin, random.direction())
        })
        .collect()
}

fn assert_clean(bench: &Bench, name: &str, triangles: &[Triangle], rays: &[Ray]) {
    let verdicts = oracle_of(triangles).closest_batch(&rays.iter().map(oracle_ray).collect::<Vec<_>>());
    let geometry = bench.geometry(triangles);
    let center =
        std::array::from_fn(|axis| 0.5 * (geometry.desc().bounds[0][axis] + geometry.desc().bounds[1][axis]));
    let mut tried = 0;
    for subject in Subject::all() {
        let is_brute_force = subject.spec.system().name == "brute-force";
        if subject.kind != StructureKind::Primitive || is_brute_force && triangles.len() > BRUTE_FORCE {
            continue;
        }
        let mut structure =
            subject.spec.create(bench.device(), &geometry, None).expect("the options are valid");
        let hits: Vec<_> = bench
            .build_and_trace(structure.as_mut(), center, rays)
            .iter()
            .map(|hit| hit.is_hit().then_some(DeviceHit { t: hit.t, primitive: Some(hit.primitive) }))
            .collect();
        let confusion = HitConfusion::measure(&verdicts, &hits, 0.0).expect("one hit per ray");
        assert!(confusion.is_clean(), "{name}, {}: {confusion:?}", subject.name());
        // Most rays start within rounding of their triangle; other ambiguous rays must stay rare.
        let share = confusion.ambiguous as f64 / confusion.rays as f64;
        println!("{name}, {}: {} rays, {:.1} % ambiguous", subject.name(), confusion.rays, 100.0 * share);
        tried += 1;
    }
    assert!(tried >= 3, "{tried} structures");
}

#[test]
fn rays_that_start_on_a_surface_are_right() {
    let bench = Bench::new();
    let count = RAYS.on(bench.device(), "rays that start on a surface");
    for (name, triangles) in [
        ("small sphere", sphere([-0.2, -0.3, -0.6], 0.1, 48)),
        ("coarse sphere", sphere([3.0, 0.5, -20.0], 5.0, 12)),
    ] {
        assert_clean(&bench, name, &triangles, &on(&triangles, count));
    }
}

/// Hit at 1.06e-8 m in exact arithmetic, which rounding cannot tell from the start of the ray.
#[test]
fn a_ray_that_starts_within_rounding_is_right() {
    let triangle = [
        [-0.246_709_5, -0.341_158_4, -0.676_100_1],
        [-0.234_160_1, -0.349_085, -0.668_141_3],
        [-0.234_160_1, -0.352_709, -0.673_127_9],
    ];
    let ray =
        Ray::new([-0.236_933_11, -0.349_243_1, -0.672_527_55], [0.387_222_74, 0.706_959, -0.591_834_07]);
    assert_clean(&Bench::new(), "one triangle", &[triangle], &[ray]);
}

#[test]
fn rays_that_start_on_a_scan_are_right() {
    let Some(folder) = std::env::var_os("RASRAY_SCENES").map(std::path::PathBuf::from) else {
        eprintln!("skipped: rays_that_start_on_a_scan_are_right needs RASRAY_SCENES");
        return;
    };
    let bench = Bench::new();
    let count = RAYS.on(bench.device(), "rays that start on a surface");
    for file in ["organic/stanford-bunny/stanford-bunny.obj", "organic/fandisk/fandisk.obj"] {
        let scene = rasray_scene_files::load(&folder.join(file), &rasray_scene_files::LoadOptions::default())
            .expect("the scan loads");
        let triangles: Vec<Triangle> = scene
            .meshes
            .iter()
            .flat_map(|mesh| {
                mesh.indices.as_chunks::<3>().0.iter().map(|ids| ids.map(|id| mesh.positions[id as usize]))
            })
            .collect();
        assert_clean(&bench, file, &triangles, &on(&triangles, count));
    }
}

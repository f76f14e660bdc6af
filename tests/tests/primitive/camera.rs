//! Lists of what the camera sees alone: hits within its view are those of brute force, bit for bit, and what
//! lies outside is missed.

use rasray_ads::{AdsError, BruteForce, CameraView, Hit, Ray, Structure, StructureKind, Viewpoint};
use rasray_gpu::Timing;
use rasray_primitive::{Addressing, Builder, Config, PrimitiveLists, Storage, Views};
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::rays::towards;
use rasray_tests::shapes::{Triangle, all_sizes};
use rasray_tracer::{TracerError, build_until_complete};

/// A camera that is turned in no simple way.
fn camera(half_width: f32, half_height: f32) -> CameraView {
    let unit = |v: [f64; 3]| {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| x / length)
    };
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
    };
    let forward = unit([0.3, -0.2, -0.9]);
    let right = unit(cross(forward, [0.1, 1.0, 0.05]));
    let [right, up, forward] = [right, cross(right, forward), forward].map(|axis| axis.map(|x| x as f32));
    CameraView { right, up, forward, half_width, half_height }
}

/// A point of the view at a depth.
fn within(eye: [f32; 3], view: &CameraView, random: &mut Random, depth: f32) -> [f32; 3] {
    let [x, y] =
        [view.half_width, view.half_height].map(|half| 0.99 * half * depth * random.between(-1.0, 1.0));
    [0, 1, 2].map(|i| eye[i] + x * view.right[i] + y * view.up[i] + depth * view.forward[i])
}

/// True if a point is well within the view.
fn sees(view: &CameraView, eye: [f32; 3], point: [f32; 3]) -> bool {
    let narrower =
        CameraView { half_width: 0.9999 * view.half_width, half_height: 0.9999 * view.half_height, ..*view };
    narrower.sees([0, 1, 2].map(|i| f64::from(point[i]) - f64::from(eye[i])))
}

/// Rays from the eye, between points of the view, from such points to anywhere, and from anywhere.
fn rays(eye: [f32; 3], view: &CameraView, random: &mut Random) -> Vec<Ray> {
    (0..4000)
        .map(|index| {
            let depth = 10.0_f32.powf(random.between(-2.0, 1.0));
            let (origin, target) = (within(eye, view, random, depth), within(eye, view, random, 7.0));
            match index % 4 {
                0 => towards(eye, target),
                1 => towards(origin, target),
                2 => Ray::new(origin, random.direction()),
                _ => random.ray(-9.0, 9.0),
            }
        })
        .collect()
}

fn lists(
    bench: &Bench,
    config: Config,
    triangles: &[Triangle],
    from: Viewpoint,
) -> Result<PrimitiveLists, TracerError> {
    let geometry = bench.geometry(triangles);
    let mut lists = PrimitiveLists::new(bench.device(), config, &geometry, None).expect("valid options");
    build_until_complete(bench.device(), &mut lists, from, Timing::None)?;
    Ok(lists)
}

#[test]
fn what_the_camera_sees_is_found_and_all_else_is_missed() {
    let bench = Bench::new();
    let triangles = all_sizes();
    let own = Config { views: Views::Camera, ..Config::robust(64) };
    let other = Config {
        storage: Storage::Linked,
        builder: Builder::Binning,
        addressing: Addressing::Address,
        pyramid: false,
        tile: 1,
        ..own
    };
    let mut random = Random::new(31);
    for (eye, view) in [
        ([0.0; 3], camera(1.0, 0.75)),
        ([0.125, -0.25, 0.375], camera(0.2, 0.3)),
        ([-3.0, 2.0, 1.5], camera(3.0, 2.0)),
    ] {
        let rays = rays(eye, &view, &mut random);
        let brute = BruteForce::new(bench.device(), &bench.geometry(&triangles), None, false).expect("valid");
        let expected = bench.trace(&brute, &rays).hits;
        let from = Viewpoint { eye, camera: Some(view) };
        let mut all: Vec<Vec<Hit>> = Vec::new();
        for config in
            [own, Config { storage: Storage::Linked, addressing: Addressing::Address, ..own }, other]
        {
            let lists = lists(&bench, config, &triangles, from).expect("the build completes");
            assert_eq!(lists.description().kind, StructureKind::LossyPrimitive);
            let hits = bench.trace(&lists, &rays).hits;
            let (mut seen, mut missed) = (0, 0);
            for (index, (hit, expected)) in hits.iter().zip(&expected).enumerate() {
                let ray = &rays[index];
                let from_eye = index % 4 == 0;
                let end = [0, 1, 2].map(|i| ray.origin[i] + expected.t * ray.direction[i]);
                let starts_within = from_eye || sees(&view, eye, ray.origin);
                if from_eye || expected.is_hit() && starts_within && sees(&view, eye, end) {
                    seen += 1;
                    assert_eq!(bits(hit), bits(expected), "{config:?}, ray {index}: {ray:?}");
                } else if bits(hit) != bits(expected) {
                    missed += 1;
                    assert!(
                        !hit.is_hit() || hit.t >= expected.t,
                        "{config:?}, ray {index}: {hit:?} {expected:?}"
                    );
                }
            }
            println!(
                "view {} x {}: {seen} rays within, {missed} others miss something",
                view.half_width, view.half_height
            );
            assert!(seen > 1500 && missed > 200, "{seen} {missed}");
            all.push(hits);
        }
        // Storage and addressing change no hit, whether it is within or not.
        assert!(all[0].iter().zip(&all[1]).all(|(a, b)| bits(a) == bits(b)));
    }
}

#[test]
fn a_view_of_the_camera_needs_one() {
    let bench = Bench::new();
    let triangles = all_sizes();
    let config = Config { views: Views::Camera, ..Config::robust(16) };
    let refused = lists(&bench, config, &triangles, [0.0; 3].into()).expect_err("there is no camera");
    assert!(refused.to_string().contains("views is camera"), "{refused}");
    let fixed = Config { centre: rasray_primitive::Centre::Fixed, ..config };
    let refused = PrimitiveLists::new(bench.device(), fixed, &bench.geometry(&triangles), None);
    assert!(matches!(refused, Err(AdsError::Option { option: "centre", .. })));
}

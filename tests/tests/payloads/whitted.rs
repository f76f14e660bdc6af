//! Mirrors that face each other, through every system: what they show of each other is that of brute force, bit for bit,
//! where triangles are found without loss, and elsewhere as bright as errors of hits allow.

use rasray_ads::StructureKind;
use rasray_gpu::Timing;
use rasray_gpu_scene::GpuScene;
use rasray_integrators::{Film, IntegratorDesc, Whitted, WhittedOptions};
use rasray_systems::{SYSTEMS, Spec};
use rasray_tests::harness::Bench;
use rasray_tests::pictures::{rendered, stage};
use rasray_tracer::build_until_complete;

const SIZE: u32 = 32;
const SAMPLES: u32 = 2;

/// Largest relative error of the mean where hits may be off.
const ALLOWED: f32 = 0.05;

fn image(bench: &Bench, scene: &GpuScene, system: &str) -> (StructureKind, Vec<[f32; 3]>) {
    let device = bench.device();
    let few = ["mmrt", "hu", "selective", "ldc"].contains(&system);
    let options = few.then(|| ("resolution".to_owned(), "256".to_owned()));
    let spec = Spec::new(system, "robust", options).expect("the options are valid");
    let mut structure =
        spec.create(device, scene.geometry(), Some(scene.binding())).expect("pipelines are made");
    build_until_complete(device, structure.as_mut(), scene.eye(), Timing::None).expect("the build completes");
    let film = Film::new(device, SIZE, SIZE).expect("a small film fits");
    let desc = IntegratorDesc::new(device, scene, &film);
    let options = WhittedOptions { ray_depth: 6, ..WhittedOptions::default() };
    let whitted = Whitted::new(&desc, options).expect("the options are valid");
    (structure.kind(), rendered(bench, &whitted, &film, SAMPLES, structure.as_mut()))
}

#[test]
fn every_system_shows_what_mirrors_show_of_each_other() {
    let bench = Bench::new();
    let scene = stage(&bench, "corridor", SIZE);
    let mean = |image: &[[f32; 3]]| image.iter().flatten().sum::<f32>() / (3 * image.len()) as f32;
    let bits = |image: &[[f32; 3]]| image.iter().map(|pixel| pixel.map(f32::to_bits)).collect::<Vec<_>>();
    let (_, expected) = image(&bench, &scene, "brute-force");
    assert!(mean(&expected) > 0.1, "{}", mean(&expected));
    let mut exact = 0;
    for system in SYSTEMS.iter().filter(|system| system.name != "brute-force") {
        let (kind, found) = image(&bench, &scene, system.name);
        let off = (mean(&found) / mean(&expected) - 1.0).abs();
        let differing = bits(&found).iter().zip(bits(&expected)).filter(|(a, b)| *a != b).count();
        println!("{}: {off:.4} off, {differing} pixels differ", system.name);
        if kind == StructureKind::Primitive {
            exact += 1;
            assert!(differing == 0, "{}: another image than brute force's", system.name);
        }
        assert!(off < ALLOWED, "{}: {off} off", system.name);
    }
    assert!(exact >= 4, "{exact} systems find triangles without loss");
}

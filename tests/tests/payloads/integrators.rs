//! Ambient occlusion, paths and photons through every system in every preset: where triangles are found
//! without loss the images are those of brute force, bit for bit; elsewhere they are as bright as errors of
//! hits allow.

use rasray_ads::StructureKind;
use rasray_gpu::Timing;
use rasray_gpu_scene::GpuScene;
use rasray_integrators::{AmbientOcclusion, Film, IntegratorDesc, Path, PhotonKind, PhotonOptions, Photons};
use rasray_systems::{Preset, SYSTEMS, Spec};
use rasray_tests::harness::{Bench, is_offered};
use rasray_tests::pictures::{rendered, stage};
use rasray_tracer::build_until_complete;

use crate::kept_pictures::Compared;

const SIZE: u32 = 32;
const SAMPLES: u32 = 4;
const BOUNCES: u32 = 2;

/// Least and largest relative errors of the means of occlusion and of light, where hits may be off, so that
/// what passes unexpectedly is noticed. Published fragments of mmrt are as thick as half a step, which hides
/// more than there is.
const ALLOWED: &[(&str, Preset, [[f32; 2]; 2])] = &[
    ("mmrt", Preset::Published, [[0.2, 0.8], [0.03, 0.2]]),
    ("dirt", Preset::Published, [[0.0, 0.12], [0.0, 0.03]]),
    ("hu", Preset::Published, [[0.0, 0.1], [0.0, 0.03]]),
    ("selective", Preset::Published, [[0.03, 0.2], [0.0, 0.1]]),
    ("ldc", Preset::Published, [[0.0, 0.02], [0.0, 0.01]]),
];

/// Occlusion, and light by paths and by photons, of every pixel.
fn images(bench: &Bench, scene: &GpuScene, spec: &Spec) -> (StructureKind, [Vec<[f32; 3]>; 3]) {
    let device = bench.device();
    let mut structure =
        spec.create(device, scene.geometry(), Some(scene.binding())).expect("pipelines are made");
    build_until_complete(device, structure.as_mut(), scene.eye(), Timing::None).expect("the build completes");
    let film = Film::new(device, SIZE, SIZE).expect("a small film fits");
    let desc = IntegratorDesc::new(device, scene, &film);
    let occlusion = AmbientOcclusion::new(&desc, f32::INFINITY).expect("the range is valid");
    let path = Path::new(&desc, BOUNCES).expect("the bounces are valid");
    let all = PhotonOptions { kind: PhotonKind::All, photon_paths: 2000, ..PhotonOptions::default() };
    let photons = Photons::new(&desc, all).expect("the options are valid");
    let found = [
        rendered(bench, &occlusion, &film, SAMPLES, structure.as_mut()),
        rendered(bench, &path, &film, SAMPLES, structure.as_mut()),
        rendered(bench, &photons, &film, SAMPLES, structure.as_mut()),
    ];
    (structure.description().kind, found)
}

fn mean(image: &[[f32; 3]]) -> f32 {
    image.iter().flatten().sum::<f32>() / (3 * image.len()) as f32
}

fn bits(image: &[[f32; 3]]) -> Vec<[u32; 3]> {
    image.iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}

#[test]
fn every_system_renders_what_brute_force_renders() {
    let bench = Bench::new();
    let scene = stage(&bench, "cornell", SIZE);
    let reference = Spec::new("brute-force", "robust", []).expect("the registry has brute force");
    let (_, expected) = images(&bench, &scene, &reference);
    let [occlusion, light, photons] = expected.each_ref().map(|image| mean(image));
    assert!(0.1 < occlusion && occlusion < 0.9 && light > 0.05, "{occlusion}, {light}");
    assert!(photons > light, "photons are scattered more often: {photons}, {light}");
    let (mut exact, mut faults) = (0, Vec::new());
    for system in SYSTEMS.iter().filter(|system| system.name != "brute-force") {
        for preset in system.presets {
            let name = format!("{} {}", system.name, preset.name());
            // Coarse views suffice for a room of 38 triangles.
            let few = ["mmrt", "hu", "selective", "ldc"].contains(&system.name);
            let options = few.then(|| ("resolution".to_owned(), "256".to_owned()));
            let spec = Spec::new(system.name, preset.name(), options).expect("the options are valid");
            if !is_offered(&spec) {
                continue;
            }
            let (kind, found) = images(&bench, &scene, &spec);
            let off: [f32; 3] =
                std::array::from_fn(|image| (mean(&found[image]) / mean(&expected[image]) - 1.0).abs());
            println!("{name}: occlusion {:.4} off, light {:.4}", off[0], off[1]);
            if kind == StructureKind::Primitive {
                exact += 1;
                for (found, expected) in found.iter().zip(&expected) {
                    let compared = Compared { picture: found, reference: expected, width: SIZE };
                    compared.assert_bits(format_args!("{name}: another image than brute force's"));
                }
                continue;
            }
            let [dark, bright] = ALLOWED
                .iter()
                .find(|row| (row.0, row.1) == (system.name, *preset))
                .unwrap_or_else(|| panic!("{name} needs a row in ALLOWED"))
                .2;
            for (what, allowed, off) in [("occlusion", dark, off[0]), ("light", bright, off[1])] {
                if !(allowed[0]..allowed[1]).contains(&off) {
                    faults.push(format!("{name}: {what} is {off} off, not within {allowed:?}"));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(exact >= 2, "{exact} systems find triangles without loss");
    // The comparison notices a pixel.
    let mut other = expected[0].clone();
    other[5][1] = f32::from_bits(other[5][1].to_bits() ^ 1);
    assert!(bits(&other) != bits(&expected[0]));
}

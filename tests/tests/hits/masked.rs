//! Structures that lose no hit against brute force where masks cut holes into triangles, bit for bit: a
//! candidate counts by the mask where the ray hits it, wherever and however a structure keeps its triangle.

use rasray_ads::{BruteForce, Hit, Ray, Structure, StructureKind, TraceMode};
use rasray_gpu::Timing;
use rasray_gpu_scene::{GpuScene, Parts, SceneTables, View};
use rasray_scene::builtin::builtin;
use rasray_scene::default_view::default_camera;
use rasray_scene::needs::Needs;
use rasray_scene::{AlphaMode, Scene};
use rasray_systems::Spec;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::invariance::Subject;
use rasray_tests::random::Random;
use rasray_tests::tier::first;
use rasray_tracer::{BatchTracer, build_until_complete};

const RAYS: usize = 1500;

/// Options with which systems promise every hit, in addition to the presets that do.
const EXACT: &[(&str, &[(&str, &str)])] = &[
    ("dirt", &[("resolution", "64")]),
    ("hu", &[("resolution", "64"), ("coverage", "conservative")]),
    ("ldc", &[("resolution", "64")]),
    ("mmrt", &[("resolution", "64"), ("coverage", "conservative"), ("builder", "binning")]),
    ("mmrt", &[("resolution", "64"), ("coverage", "conservative"), ("storage", "sb"), ("march", "pyramid")]),
    ("hu", &[("resolution", "64"), ("coverage", "conservative"), ("builder", "binning")]),
    ("mmrt", &[("resolution", "64"), ("coverage", "conservative")]),
];

/// Number of [`EXACT`] tried in the quick tier.
const QUICK: usize = 5;

/// Presets that must be among those found by what they promise.
const KEEPERS: &[&str] = &["brute-force robust", "bricks robust", "bvh robust", "dirt robust"];

/// The hall whose banners and plants are cut out by masks.
fn hall() -> Scene {
    builtin("atrium:detail=0.25").expect("it is built in").expect("its parameter is valid")
}

fn stage(bench: &Bench, scene: &Scene) -> GpuScene {
    let camera = scene.cameras.first().cloned().unwrap_or_else(|| default_camera(scene));
    let origin = SceneTables::default_frame_origin(scene, camera.world_from_camera.translation);
    let tables = SceneTables::new(scene, origin, &Parts::from(&Needs::all())).expect("valid tables");
    let view = View { camera, width: 16, height: 16, seed: 1 };
    GpuScene::upload(bench.device(), &tables, &view).expect("it fits")
}

fn rays(scene: &GpuScene) -> Vec<Ray> {
    let bounds = scene.geometry().bounds();
    let mut random = Random::new(97);
    (0..RAYS).map(|_| Ray::new(random.within(bounds), random.direction())).collect()
}

fn hits(bench: &Bench, structure: &dyn Structure, rays: &[Ray]) -> Vec<Hit> {
    let tracer = BatchTracer::new(bench.device(), rays.len() as u32).expect("a queue fits");
    tracer.trace(structure, rays, TraceMode::Closest, Timing::None).expect("all rays finish").hits
}

fn different(found: &[Hit], expected: &[Hit]) -> usize {
    found.iter().zip(expected).filter(|(hit, expected)| bits(hit) != bits(expected)).count()
}

#[test]
fn masks_are_looked_up_where_rays_meet_triangles() {
    let bench = Bench::new();
    let scene = stage(&bench, &hall());
    let rays = rays(&scene);
    let brute = |binding| {
        let structure = BruteForce::new(bench.device(), scene.geometry(), binding, false).expect("kernels");
        hits(&bench, &structure, &rays)
    };
    let (expected, opaque) = (brute(Some(scene.binding())), brute(None));
    let behind_holes = different(&opaque, &expected);
    println!(
        "{behind_holes} of {RAYS} rays pass through holes of {} triangles",
        scene.geometry().triangle_count()
    );
    assert!(behind_holes > RAYS / 100, "{behind_holes} rays pass through holes");
    let presets: Vec<Subject> =
        Subject::all().into_iter().filter(|subject| subject.kind == StructureKind::Primitive).collect();
    for name in KEEPERS {
        assert!(presets.iter().any(|subject| subject.name() == *name), "{name} no longer promises every hit");
    }
    for spec in presets.into_iter().map(|subject| subject.spec).chain(exact()) {
        let name = format!("{} {:?}", spec.system().name, spec.options());
        let (kind, found) = built_hits(&bench, &spec, &scene, &rays);
        assert_eq!(kind, StructureKind::Primitive, "{name}");
        assert_eq!(different(&found, &expected), 0, "{name}");
    }
}

/// The specs of [`EXACT`].
fn exact() -> impl Iterator<Item = Spec> {
    first(EXACT, QUICK).iter().map(|(system, options)| {
        let given = options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
        Spec::new(system, "robust", given).expect("the options are valid")
    })
}

/// Kind and hits of a structure of the scene as seen from its eye.
fn built_hits(bench: &Bench, spec: &Spec, scene: &GpuScene, rays: &[Ray]) -> (StructureKind, Vec<Hit>) {
    let mut structure =
        spec.create(bench.device(), scene.geometry(), Some(scene.binding())).expect("it is made");
    build_until_complete(bench.device(), &mut *structure, scene.eye(), Timing::None).expect("it is built");
    (structure.description().kind, hits(bench, &*structure, rays))
}

/// Above 1, the cutoff hides a surface whole, textured as it is: what is behind is hit, bit for bit.
#[test]
fn a_cutoff_above_one_hides_its_triangles_from_every_structure() {
    let bench = Bench::new();
    let mut scene = hall();
    let mut textured = 0;
    for material in &mut scene.materials {
        if let AlphaMode::Mask { cutoff } = &mut material.alpha_mode {
            *cutoff = f32::INFINITY;
            textured += usize::from(material.base_color_texture.is_some());
        }
    }
    assert!(textured > 0, "the hall has no textured mask");
    let hidden = |scene: &Scene, mesh: usize| {
        matches!(scene.materials[scene.meshes[mesh].material].alpha_mode, AlphaMode::Mask { .. })
    };
    let triangles: Vec<bool> = scene
        .instances
        .iter()
        .flat_map(|instance| {
            std::iter::repeat_n(hidden(&scene, instance.mesh), scene.meshes[instance.mesh].triangle_count())
        })
        .collect();
    let stage = stage(&bench, &scene);
    let rays = rays(&stage);
    let brute = |binding| {
        let structure = BruteForce::new(bench.device(), stage.geometry(), binding, false).expect("kernels");
        hits(&bench, &structure, &rays)
    };
    let on_hidden = |found: &[Hit]| {
        found.iter().filter(|hit| triangles.get(hit.primitive as usize) == Some(&true)).count()
    };
    let (expected, opaque) = (brute(Some(stage.binding())), brute(None));
    assert!(on_hidden(&opaque) > RAYS / 100, "{} rays hit what is to be hidden", on_hidden(&opaque));
    assert_eq!(on_hidden(&expected), 0);
    for spec in Subject::by_turns().into_iter().map(|subject| subject.spec).chain(exact()) {
        let name = format!("{} {:?}", spec.system().name, spec.options());
        let (kind, found) = built_hits(&bench, &spec, &stage, &rays);
        assert_eq!(on_hidden(&found), 0, "{name}");
        if kind == StructureKind::Primitive {
            assert_eq!(different(&found, &expected), 0, "{name}");
        }
    }
}

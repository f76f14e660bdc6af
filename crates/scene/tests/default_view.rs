//! Where the default camera stands in rooms and around solids, and what counts as light.

use std::path::PathBuf;

use glam::{DAffine3, DVec3};
use rasray_scene::default_view::{bounds, default_camera, ensure_lit, is_lit};
use rasray_scene::needs::{Integrator, Needs, Term, Workload};
use rasray_scene::{
    Camera, Environment, Instance, Light, LoadOptions, Material, Mesh, Projection, Scene, TextureRef,
};

/// The quads of a box, seen counter-clockwise from outside, by the corners' bits (x, y, z).
/// In order: left, right, floor, ceiling, back (-z), front.
const SIDES: [[usize; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
const FLOOR: usize = 2;
const FRONT: usize = 5;

/// A box of this size around the origin without some of its sides.
fn box_mesh(size: [f32; 3], inwards: bool, without: &[usize]) -> Mesh {
    let corner = |bits: usize| [0, 1, 2].map(|axis| size[axis] * ((bits >> axis & 1) as f32 - 0.5));
    let mut indices = Vec::new();
    for (_, quad) in SIDES.iter().enumerate().filter(|(side, _)| !without.contains(side)) {
        for mut triangle in [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]] {
            if inwards {
                triangle.swap(1, 2);
            }
            indices.extend(triangle.map(|index| index as u32));
        }
    }
    Mesh { positions: (0..8).map(corner).collect(), indices, ..Mesh::default() }
}

fn scene_of(placed: Vec<(Mesh, DAffine3)>) -> Scene {
    let mut scene = Scene { materials: vec![Material::default()], ..Scene::default() };
    for (mesh, world_from_mesh) in placed {
        let instance = Instance { name: "box".to_owned(), mesh: scene.meshes.len(), world_from_mesh };
        scene.instances.push(instance);
        scene.meshes.push(mesh);
    }
    scene
}

fn one(mesh: Mesh) -> Scene {
    scene_of(vec![(mesh, DAffine3::IDENTITY)])
}

const HALL: [f32; 3] = [10.0, 3.0, 4.0];

fn eye(camera: &Camera) -> DVec3 {
    camera.world_from_camera.translation
}

fn forward(camera: &Camera) -> DVec3 {
    -camera.world_from_camera.matrix3.z_axis
}

fn stands_inside(scene: &Scene) -> bool {
    let (low, high) = bounds(scene).expect("triangles");
    let eye = eye(&default_camera(scene));
    eye.cmpgt(low).all() && eye.cmplt(high).all()
}

#[test]
fn in_a_hall_the_camera_looks_along_it() {
    let scene = one(box_mesh(HALL, true, &[]));
    let camera = default_camera(&scene);
    let (eye, forward) = (eye(&camera), forward(&camera));
    let clearance = 0.02 * DVec3::new(10.0, 3.0, 4.0).length();
    let walls = DVec3::new(5.0, 1.5, 2.0) - eye.abs();
    assert!(walls.min_element() >= clearance * (1.0 - 1.0e-9), "{eye} is clear of the walls");
    assert!(forward.x.abs() > 0.9 && forward.y < 0.0 && forward.y > -0.1, "along the hall: {forward}");
    assert!(eye.x * forward.x < -3.0, "it stands at one end and sees the other: {eye}");
    let Projection::Perspective { fov_y } = camera.projection else { panic!("perspective") };
    assert!((60.0..=70.001).contains(&fov_y.to_degrees()), "{}", fov_y.to_degrees());
    let again = default_camera(&scene);
    assert_eq!(camera.world_from_camera, again.world_from_camera);
}

#[test]
fn a_solid_is_seen_from_outside() {
    assert!(!stands_inside(&one(box_mesh(HALL, false, &[]))));
    let hall = box_mesh(HALL, true, &[]);
    let mut unreliable = hall.clone();
    for triangle in unreliable.indices.chunks_exact_mut(3).step_by(2) {
        triangle.swap(1, 2);
    }
    assert!(stands_inside(&one(hall)));
    assert!(!stands_inside(&one(unreliable)), "sides at random");
}

#[test]
fn mirrors_change_nothing_about_sides() {
    let mirror = DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    assert!(stands_inside(&scene_of(vec![(box_mesh(HALL, true, &[]), mirror)])));
    assert!(!stands_inside(&scene_of(vec![(box_mesh(HALL, false, &[]), mirror)])));
}

#[test]
fn size_and_place_in_the_world_do_not_matter() {
    let near = eye(&default_camera(&one(box_mesh(HALL, true, &[]))));
    for exponent in [-6, 0, 6] {
        let scale = 10.0_f64.powi(exponent);
        for shift in [0.0, 1.0e4] {
            let offset = DVec3::new(shift, -shift, shift) * scale;
            let place = DAffine3::from_translation(offset) * DAffine3::from_scale(DVec3::splat(scale));
            let scene = scene_of(vec![(box_mesh(HALL, true, &[]), place)]);
            let there = (eye(&default_camera(&scene)) - offset) / scale;
            assert!((there.abs() - near.abs()).length() < 1.0e-6, "{near} {there} at {scale} + {shift}");
        }
    }
}

#[test]
fn a_hollow_thing_without_a_floor_is_no_room() {
    let bell = |inner: &[usize]| {
        let shell = box_mesh([2.0; 3], false, &[FLOOR]);
        scene_of(vec![
            (shell, DAffine3::IDENTITY),
            (box_mesh([1.9; 3], true, inner), DAffine3::from_translation(DVec3::Y * 0.01)),
        ])
    };
    assert!(!stands_inside(&bell(&[FLOOR])));
    assert!(stands_inside(&bell(&[])), "with a floor it is a house");
}

#[test]
fn into_a_nook_of_a_large_scene_nobody_goes() {
    let nook = || (box_mesh([1.0; 3], true, &[]), DAffine3::IDENTITY);
    let far = |x: f64| (box_mesh([1.0; 3], false, &[]), DAffine3::from_translation(DVec3::new(x, 0.0, 0.0)));
    assert!(stands_inside(&scene_of(vec![nook()])));
    assert!(!stands_inside(&scene_of(vec![nook(), far(-4.0), far(4.0)])));
}

#[test]
fn one_open_side_is_looked_in_through() {
    let scene = one(box_mesh([4.0, 3.0, 5.0], true, &[FRONT]));
    let camera = default_camera(&scene);
    assert!(forward(&camera).distance(DVec3::NEG_Z) < 1.0e-12);
    let eye = eye(&camera);
    assert!(eye.x == 0.0 && eye.y == 0.0 && eye.z > 2.5);
    let Projection::Perspective { fov_y } = camera.projection else { panic!("perspective") };
    let half_seen = f64::from(fov_y / 2.0).tan() * (eye.z - 2.5);
    assert!(half_seen >= 2.0, "the whole side is in a square picture: {half_seen}");

    let turned = DAffine3::from_rotation_y(std::f64::consts::FRAC_PI_2);
    let scene = scene_of(vec![(box_mesh([4.0, 3.0, 5.0], true, &[FRONT]), turned)]);
    assert!(forward(&default_camera(&scene)).distance(DVec3::NEG_X) < 1.0e-9);
    let courtyard = one(box_mesh(HALL, true, &[3]));
    assert!(stands_inside(&courtyard), "the sky is no side to look in through");
}

#[test]
fn what_stands_in_the_middle_is_looked_past() {
    let obstacle = box_mesh([0.5, 0.9, 0.5], false, &[]);
    let beside = DAffine3::from_translation(DVec3::new(1.0, -1.0, 0.0));
    let scene = scene_of(vec![(box_mesh(HALL, true, &[]), DAffine3::IDENTITY), (obstacle, beside)]);
    let camera = default_camera(&scene);
    let (eye, forward) = (eye(&camera), forward(&camera));
    assert!(stands_inside(&scene) && (eye.x * forward.x) < -3.0, "{eye} {forward}");
}

#[test]
fn what_is_broken_or_too_large_is_seen_from_outside() {
    let mut broken = box_mesh(HALL, true, &[]);
    broken.positions[3] = [f32::NAN; 3];
    broken.indices.extend([1000, 1, 2, 0]);
    assert!(default_camera(&one(broken)).world_from_camera.is_finite());

    let place = DAffine3::from_translation(DVec3::splat(f64::INFINITY));
    let lost = scene_of(vec![(box_mesh(HALL, true, &[]), place)]);
    assert!(default_camera(&lost).world_from_camera.is_finite());

    let mut stacked = one(box_mesh(HALL, true, &[]));
    stacked.meshes[0].indices = stacked.meshes[0].indices.repeat(20_000);
    assert!(!stands_inside(&stacked), "every ray meets thousands");

    let mut heavy = one(box_mesh(HALL, true, &[]));
    heavy.meshes[0].indices.extend([0; 360_000]);
    assert!(stands_inside(&heavy), "specks in a corner");
    heavy.instances = vec![heavy.instances[0].clone(); 71];
    assert!(!stands_inside(&heavy), "more than 2^23 triangles");
}

#[test]
fn real_scenes_are_judged_right() {
    let Some(folder) = std::env::var_os("RASRAY_SCENES").map(PathBuf::from) else {
        eprintln!("skipped: RASRAY_SCENES is not set");
        return;
    };
    for (file, inside) in [
        ("architecture/crytek_sponza/sponza.obj", true),
        ("architecture/medieval_building/Medieval_building.obj", false),
        ("organic/stanford-bunny/stanford-bunny.obj", false),
        ("organic/teapot/teapot.obj", false),
        ("pbr/DamagedHelmet/DamagedHelmet.glb", false),
        ("animated/CesiumMilkTruck/CesiumMilkTruck.glb", false),
        ("emissive/EmissiveStrengthTest/EmissiveStrengthTest.glb", false),
        ("morph/MorphStressTest/MorphStressTest.glb", false),
    ] {
        let mut scene = rasray_scene::load(&folder.join(file), &LoadOptions::default()).expect(file);
        assert_eq!(stands_inside(&scene), inside, "{file}");
        if file.ends_with("DamagedHelmet.glb") {
            assert!(ensure_lit(&mut scene), "a few glowing marks light nothing");
        }
    }
}

#[test]
fn emission_through_a_texture_is_decoration() {
    let texture = TextureRef { texture: 0, uv_set: 0, uv_transform: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] };
    let glowing = Material { emission: [1.0; 3], emission_texture: Some(texture), ..Material::default() };
    let with = |material: &Material| {
        let mut scene = one(box_mesh(HALL, false, &[]));
        scene.materials[0] = material.clone();
        scene
    };
    let workload = Workload { integrator: Integrator::Path, bounces: 2 };
    let mut scene = with(&glowing);
    assert!(!is_lit(&scene));
    assert!(!Needs::of(&scene, workload).requires(Term::Environment));
    assert!(ensure_lit(&mut scene));
    assert!(matches!(scene.environment, Environment::Constant([1.0, 1.0, 1.0])));
    assert_eq!(scene.warnings.len(), 1);
    assert_eq!(scene.warnings[0].kind, "default-light");
    assert!(scene.warnings[0].message.contains("emission textures"), "{}", scene.warnings[0].message);
    let needs = Needs::of(&scene, workload);
    assert!(needs.requires(Term::Environment), "it is a light now");
    assert!(needs.requires(Term::Emission), "and what glows still does");

    let mut dark = with(&Material::default());
    assert!(ensure_lit(&mut dark));
    assert!(!dark.warnings[0].message.contains("textures"), "{}", dark.warnings[0].message);

    let mut lamp = with(&glowing);
    lamp.materials.push(Material { emission: [0.0, 0.0, 2.0], ..Material::default() });
    assert!(!is_lit(&lamp), "nothing is made of it");
    lamp.meshes[0].material = 1;
    assert!(!ensure_lit(&mut lamp) && lamp.warnings.is_empty());
    let mut sun = with(&glowing);
    sun.lights.push(Light::Directional { direction: DVec3::NEG_Y, irradiance: [1.0; 3] });
    assert!(!ensure_lit(&mut sun));
    assert!(!ensure_lit(&mut with(&Material { unlit: true, ..glowing })), "unlit surfaces show themselves");
}

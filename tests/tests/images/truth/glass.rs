//! Light through stacks of glass, and around the critical angle.

use glam::DVec3;
use rasray_scene::{Camera, Environment, Material, Mesh, Scene};
use rasray_tests::harness::Bench;
use rasray_tests::image_truth::{
    Studio, System, assert_refused, assert_truth, box_around, box_faces, glass, interface_transmission,
    normal_reflectance, parallel, scene_of, square, unlit,
};
use rasray_tests::tier::is_full;

use super::{RESOLUTION, grey, law, samples};

const SIZE: u32 = 32;

/// Width that each stack has for itself.
const APART: f64 = 10.0;

/// A stack: its faces around x = 0 with materials 0 (glass), 1 (glass without thickness) and 2 (water), the
/// reflectances of its interfaces, and scatterings enough for all light but a thousandth.
struct Stack {
    name: &'static str,
    faces: Vec<Mesh>,
    interfaces: Vec<f64>,
    bounces: u32,
}

const WATER: f32 = 1.33;

/// Plates a fifth of a metre thick, walls without thickness (one interface each), and a hollow block with
/// water in its cavity.
fn stacks() -> Vec<Stack> {
    let [outer, inner] = [1.5, f64::from(WATER)].map(normal_reflectance);
    let plate = |i: usize| box_faces(DVec3::Z * (0.5 * i as f64 + 1.0), DVec3::new(3.0, 3.0, 0.1), 0);
    let plates = |name, count: usize, bounces| Stack {
        name,
        faces: (0..count).flat_map(plate).collect(),
        interfaces: vec![outer; 2 * count],
        bounces,
    };
    let sheet = |i: usize| square(DVec3::Z * (0.5 * i as f64 + 1.0), DVec3::X * 3.0, DVec3::Y * 3.0, 1);
    let sheets = Stack {
        name: "3 sheets",
        faces: (0..3).map(sheet).collect(),
        interfaces: vec![outer; 3],
        bounces: 12,
    };
    let centre = DVec3::Z * 3.0;
    let mut faces = box_faces(centre, DVec3::splat(2.0), 0);
    faces.extend(box_around(centre, DVec3::splat(1.8), 0));
    faces.extend(box_faces(centre, DVec3::splat(1.0), 2));
    let interfaces = vec![outer, outer, inner, inner, outer, outer];
    let nested = Stack { name: "nested blocks", faces, interfaces, bounces: 24 };
    vec![
        plates("1 plate", 1, 10),
        plates("2 plates", 2, 16),
        plates("4 plates", 4, 32),
        plates("8 plates", 8, 56),
        sheets,
        nested,
    ]
}

/// All stacks side by side before a lamp of radiance 1, in the dark.
fn before_lamp(ior: f32) -> Scene {
    let mut meshes = Vec::new();
    for (number, stack) in stacks().into_iter().enumerate() {
        meshes.extend(stack.faces.into_iter().map(|mut face| {
            face.positions.iter_mut().for_each(|p| p[0] += (APART * number as f64) as f32);
            face
        }));
    }
    let middle = 0.5 * APART * 5.0;
    meshes.push(square(DVec3::new(middle, 0.0, 8.0), DVec3::X * 40.0, DVec3::Y * 9.0, 3));
    let thin = Material { thickness: 0.0, ..glass(ior) };
    scene_of(meshes, vec![glass(ior), thin, glass(WATER), unlit(1.0)])
}

fn camera(number: usize) -> Camera {
    let eye = DVec3::new(APART * number as f64, 0.0, 0.05);
    parallel(eye, eye + DVec3::Z, 0.3)
}

#[test]
fn stacks_of_glass_let_through_what_their_interfaces_leave() {
    let bench = Bench::new();
    let [mut stage, mut broken] =
        [1.5, 1.6].map(|ior| Studio::new(&bench, &before_lamp(ior), camera(0), SIZE, System::BruteForce));
    for (number, stack) in stacks().iter().enumerate() {
        // The quick tier leaves out the four plates.
        if number == 2 && !is_full() {
            continue;
        }
        let truth = grey(interface_transmission(&stack.interfaces));
        stage.look(camera(number));
        let found = stage.estimate(&stage.path(stack.bounces), samples(&bench, 16));
        assert_truth(stack.name, &found, truth, 1e-3);
        if number == 3 || number == 5 {
            broken.look(camera(number));
            let found = broken.estimate(&broken.path(stack.bounces), samples(&bench, 16));
            assert_refused(stack.name, &found, truth, 1e-3);
        }
    }
}

#[test]
fn fragments_show_light_through_two_plates() {
    let bench = Bench::new();
    let system = System::Fragments(RESOLUTION);
    let truth = grey(interface_transmission(&stacks()[1].interfaces));
    // One trace per interface, and one to the lamp.
    let slack = law(system, 5);
    for (ior, right) in [(1.5, true), (2.0, false)] {
        let stage = Studio::new(&bench, &before_lamp(ior), camera(1), SIZE, system);
        let check = if right { assert_truth } else { assert_refused };
        check("2 plates, fragments", &stage.estimate(&stage.path(8), samples(&bench, 4)), truth, slack);
    }
}

/// From within glass, what is transmitted under the angle shows the sky; what is reflected ends at the
/// next surface. Up to the critical angle the model's reflectance is Schlick's of the outer angle.
#[test]
fn the_critical_angle_is_met_without_a_jump() {
    let bench = Bench::new();
    let ior = 1.5_f32;
    let make = |ior| {
        let faces = box_faces(DVec3::ZERO, DVec3::new(50.0, 0.5, 50.0), 0);
        let mut scene = scene_of(faces, vec![glass(ior)]);
        scene.environment = Environment::Constant([1.0; 3]);
        scene
    };
    let camera = |sine: f64| {
        let direction = DVec3::new(0.6 * sine, (1.0 - sine * sine).sqrt(), 0.8 * sine);
        parallel(DVec3::ZERO, direction, 1e-4)
    };
    let transmitted = |sine: f64| {
        let outer = f64::from(ior) * sine;
        let f0 = normal_reflectance(f64::from(ior));
        if outer >= 1.0 { 0.0 } else { (1.0 - f0) * (1.0 - (1.0 - (1.0 - outer * outer).sqrt()).powi(5)) }
    };
    let critical = 1.0 / f64::from(ior);
    let mut stage = Studio::new(&bench, &make(ior), camera(0.0), SIZE, System::BruteForce);
    let mut broken = Studio::new(&bench, &make(1.45), camera(0.0), SIZE, System::BruteForce);
    let (path, broken_path) = (stage.path(1), broken.path(1));
    let ulp = f64::from(f32::EPSILON);
    for sine in [0.3, 0.5, 0.6, 0.66, critical * (1.0 - 1e-4), 0.7, 0.9] {
        stage.look(camera(sine));
        let name = format!("leaving glass under the sine {sine}");
        assert_truth(&name, &stage.estimate(&path, samples(&bench, 8)), grey(transmitted(sine)), 0.0);
    }
    // Within rounding of the critical angle either side may be taken, and hardly anything passes.
    for ulps in -4..=4 {
        let sine = critical * (1.0 + f64::from(ulps) * ulp);
        stage.look(camera(sine));
        let found = stage.estimate(&path, samples(&bench, 4));
        assert!(found.mean[0] < 1e-2, "at the critical angle and {ulps} ulps: {found:?}");
    }
    broken.look(camera(0.66));
    let found = broken.estimate(&broken_path, samples(&bench, 8));
    assert_refused("leaving glass of another index", &found, grey(transmitted(0.66)), 0.0);
}

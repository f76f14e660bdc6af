//! Irradiance of a Lambertian polygon at points of several orientations against Lambert's edge sum.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use rasray_scene::{Camera, Mesh, Scene};
use rasray_tests::harness::Bench;
use rasray_tests::image_truth::{
    Studio, assert_refused, assert_truth, diffuse, glowing, parallel, polygon_irradiance, scene_of, square,
};

use super::{SYSTEMS, by_system, grey, law, samples};

const ALBEDO: f32 = 0.75;

/// An irregular pentagon, tilted, about a metre above the floor.
fn corners(scale: f64) -> Vec<DVec3> {
    let (u, v) = (DVec3::new(0.9, 0.2, 0.1).normalize(), DVec3::new(-0.1, 0.3, 0.8).normalize());
    let corner = |k: u32| {
        let (angle, radius) = (TAU * f64::from(k) / 5.0, scale * (0.4 + 0.06 * f64::from(k)));
        let corner = DVec3::new(0.1, 1.0, -0.1) + (u * angle.cos() + v * angle.sin()) * radius;
        // As uploaded.
        corner.as_vec3().as_dvec3()
    };
    (0..5).map(corner).collect()
}

fn light(scale: f64) -> Mesh {
    Mesh {
        name: "pentagon".to_owned(),
        positions: corners(scale).iter().map(|corner| corner.as_vec3().to_array()).collect(),
        indices: vec![0, 1, 2, 0, 2, 3, 0, 3, 4],
        material: 1,
        ..Mesh::default()
    }
}

/// Points and unit normals: below the light, aside, leaning towards it, and with part or all of it below
/// the horizon.
fn receivers() -> [(DVec3, DVec3); 6] {
    [
        (DVec3::new(0.0, 0.0, 0.0), DVec3::Y),
        (DVec3::new(1.5, 0.0, 0.4), DVec3::Y),
        (DVec3::new(-1.2, 0.1, 0.3), DVec3::new(0.5, 0.8, -0.2).normalize()),
        (DVec3::new(0.4, 0.0, 0.9), DVec3::new(0.8, 0.35, 0.1).normalize()),
        (DVec3::new(-0.3, 0.05, -0.8), DVec3::new(-0.3, 0.5, -0.6).normalize()),
        (DVec3::new(-0.5, 0.0, 0.6), DVec3::NEG_Y),
    ]
}

fn scene(scale: f64) -> Scene {
    let mut meshes = vec![light(scale)];
    for (point, normal) in receivers() {
        let u = normal.any_orthonormal_vector();
        meshes.push(square(point, u * 5e-3, normal.cross(u) * 5e-3, 0));
    }
    scene_of(meshes, vec![diffuse([ALBEDO; 3]), glowing([0.0; 3], [2.0; 3])])
}

fn camera((point, normal): (DVec3, DVec3)) -> Camera {
    parallel(point + 0.02 * normal, point, 1e-5)
}

#[test]
fn a_polygon_lights_points_by_the_sum_over_its_edges() {
    let bench = Bench::new();
    let truth =
        |(point, normal)| 2.0 * f64::from(ALBEDO) / PI * polygon_irradiance(point, normal, &corners(1.0));
    // Some of the light's corners lie below the horizon of the fourth and fifth receiver, all of the last.
    let below = |(point, normal): (DVec3, DVec3)| {
        corners(1.0).iter().filter(|corner| normal.dot(**corner - point) < 0.0).count()
    };
    assert_eq!(receivers().map(|r| below(r) > 0), [false, false, false, true, true, true]);
    assert!(below(receivers()[3]) < 5 && below(receivers()[4]) < 5 && below(receivers()[5]) == 5);
    for system in SYSTEMS {
        let size = by_system(system, 64, 32);
        let samples = samples(&bench, by_system(system, 12, 16));
        let scale = by_system(system, 1.04, 1.1);
        let mut stage = Studio::new(&bench, &scene(1.0), camera(receivers()[0]), size, system);
        let mut broken = Studio::new(&bench, &scene(scale), camera(receivers()[0]), size, system);
        let (path, broken_path) = (stage.path(1), broken.path(1));
        let slack = law(system, 2);
        for (number, receiver) in receivers().into_iter().enumerate().take(by_system(system, 6, 3)) {
            let name = format!("polygon light on receiver {number}, {system:?}");
            stage.look(camera(receiver));
            assert_truth(&name, &stage.estimate(&path, samples), grey(truth(receiver)), slack);
            if number == 1 {
                broken.look(camera(receiver));
                assert_refused(&name, &broken.estimate(&broken_path, samples), grey(truth(receiver)), slack);
            }
        }
    }
}

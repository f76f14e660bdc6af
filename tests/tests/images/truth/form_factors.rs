//! Light that squares, spheres and walls exchange or hide.

use std::f64::consts::PI;

use glam::DVec3;
use rasray_scene::{Camera, Mesh, Scene};
use rasray_tests::harness::Bench;
use rasray_tests::image_truth::{
    Estimate, Studio, System, assert_refused, assert_truth, convex_occlusion, diffuse, glowing,
    next_to_sphere, octahedron_sphere, parallel, parallel_rectangles, perpendicular_rectangles,
    polygon_irradiance, scene_of, square, triangles,
};

use super::{RESOLUTION, SYSTEMS, by_system, grey, law, samples};

/// A white unit square from the origin along x and z, and an emitter.
fn squares(emitter: Mesh) -> Scene {
    let receiver = square(DVec3::new(0.5, 0.0, 0.5), DVec3::X * 0.5, DVec3::NEG_Z * 0.5, 0);
    scene_of(vec![receiver, emitter], vec![diffuse([1.0; 3]), glowing([0.0; 3], [1.0; 3])])
}

fn opposite(distance: f64) -> Scene {
    squares(square(DVec3::new(0.5, distance, 0.5), DVec3::X * 0.5, DVec3::Z * 0.5, 1))
}

fn upright(height: f64) -> Scene {
    squares(square(DVec3::new(0.0, 0.5 * height, 0.5), DVec3::Y * 0.5 * height, DVec3::Z * 0.5, 1))
}

/// Shows exactly the receiver; the mean over it is the form factor towards the emitter.
fn above(height: f64) -> Camera {
    parallel(DVec3::new(0.5, height, 0.5), DVec3::new(0.5, 0.0, 0.5), 0.5)
}

fn direct(bench: &Bench, scene: &Scene, camera: Camera, system: System) -> Estimate {
    let stage = Studio::new(bench, scene, camera, by_system(system, 64, 32), system);
    stage.estimate(&stage.path(1), samples(bench, by_system(system, 12, 16)))
}

#[test]
fn squares_exchange_their_form_factors() {
    let bench = Bench::new();
    let (opposed, nearby) = (parallel_rectangles(1.0, 1.0, 1.0), perpendicular_rectangles(1.0, 1.0, 1.0));
    for system in SYSTEMS {
        for (name, truth, right, broken, eye) in [
            ("parallel squares", opposed, opposite(1.0), opposite(1.1), 0.5),
            ("perpendicular squares", nearby, upright(1.0), upright(0.8), 2.0),
        ] {
            let slack = law(system, 2);
            let name = format!("{name}, {system:?}");
            assert_truth(&name, &direct(&bench, &right, above(eye), system), grey(truth), slack);
            assert_refused(&name, &direct(&bench, &broken, above(eye), system), grey(truth), slack);
        }
    }
}

fn floor() -> Mesh {
    square(DVec3::ZERO, DVec3::X * 50.0, DVec3::NEG_Z * 50.0, 0)
}

fn occlusion(bench: &Bench, stage: &Studio<'_>) -> Estimate {
    stage.estimate(&stage.occlusion(f32::INFINITY), samples(bench, 8))
}

#[test]
fn a_sphere_on_a_plane_hides_its_share() {
    let bench = Bench::new();
    let ball = |radius: f64| octahedron_sphere(DVec3::Y * radius, radius, 2, 0);
    let scene = |radius| scene_of(vec![floor(), ball(radius)], vec![diffuse([0.5; 3])]);
    let facets = triangles(&ball(1.0));
    // Low from the side: the sphere does not hide the point.
    let camera =
        |distance: f64| parallel(DVec3::new(distance + 4.7, 1.71, 0.0), DVec3::new(distance, 0.0, 0.0), 1e-3);
    let mut stage = Studio::new(&bench, &scene(1.0), camera(0.5), 64, System::BruteForce);
    let mut broken = Studio::new(&bench, &scene(1.1), camera(0.5), 64, System::BruteForce);
    let truth = |distance: f64| grey(1.0 - convex_occlusion(DVec3::X * distance, DVec3::Y, &facets));
    for distance in [0.5, 1.0, 2.0, 4.0] {
        let hidden = 1.0 - truth(distance)[0];
        let sphere = next_to_sphere(1.0, 1.0, distance);
        assert!(hidden < sphere && hidden > 0.9 * sphere, "facets lie a little inside: {hidden} {sphere}");
        let name = format!("sphere {distance} m aside");
        stage.look(camera(distance));
        assert_truth(&name, &occlusion(&bench, &stage), truth(distance), 0.0);
        if distance <= 1.0 {
            broken.look(camera(distance));
            assert_refused(&name, &occlusion(&bench, &broken), truth(distance), 0.0);
        }
    }
    // One point's occlusion by fragments is off by the share of the sphere that a cell covers: cells are
    // 10 m / N here.
    let resolution = 4 * RESOLUTION;
    let slack = 1.5 * 10.0 / f64::from(resolution) / truth(1.0)[0];
    let fragments = System::Fragments(resolution);
    let name = format!("sphere 1 m aside, {fragments:?}");
    let stage = Studio::new(&bench, &scene(1.0), camera(1.0), 32, fragments);
    assert_truth(&name, &occlusion(&bench, &stage), truth(1.0), slack);
    let broken = Studio::new(&bench, &scene(1.5), camera(1.0), 32, fragments);
    assert_refused(&name, &occlusion(&bench, &broken), truth(1.0), slack);
}

#[test]
fn walls_and_corners_hide_a_half_and_three_quarters() {
    let bench = Bench::new();
    let walls = |height: f64| {
        let half = 0.5 * height;
        [
            square(DVec3::new(0.0, half, 10.0), DVec3::Y * half, DVec3::Z * 10.0, 0),
            square(DVec3::new(10.0, half, 0.0), DVec3::X * 10.0, DVec3::Y * half, 0),
        ]
    };
    let hidden = |walls: &[Mesh], point: DVec3| -> f64 {
        let all = walls.iter().flat_map(triangles);
        all.map(|triangle| polygon_irradiance(point, DVec3::Y, &triangle)).sum::<f64>() / PI
    };
    let camera = |point: DVec3| parallel(point + DVec3::new(2.0, 2.0, 1.0), point, 1e-5);
    let [corner, wall] = [DVec3::new(1e-3, 0.0, 1e-3), DVec3::new(1e-3, 0.0, 5.0)];
    assert!((hidden(&walls(10.0), corner) - 0.75).abs() < 1e-3);
    assert!((hidden(&walls(10.0)[..1], wall) - 0.5).abs() < 0.03);
    let make = |count: usize, height: f64| {
        let mut meshes = vec![floor()];
        meshes.extend(walls(height).into_iter().take(count));
        scene_of(meshes, vec![diffuse([0.5; 3])])
    };
    let edge = DVec3::new(4.0, 0.0, 3.0);
    let mut stage = Studio::new(&bench, &make(2, 10.0), camera(corner), 64, System::BruteForce);
    for (name, point) in [("corner", corner), ("wall", wall), ("open", edge)] {
        stage.look(camera(point));
        let truth = grey(1.0 - hidden(&walls(10.0), point));
        assert_truth(name, &occlusion(&bench, &stage), truth, 0.0);
    }
    let mut broken = Studio::new(&bench, &make(1, 10.0), camera(corner), 64, System::BruteForce);
    for (name, point) in [("corner", corner), ("open", edge)] {
        broken.look(camera(point));
        let truth = grey(1.0 - hidden(&walls(10.0), point));
        assert_refused(name, &occlusion(&bench, &broken), truth, 0.0);
    }
}

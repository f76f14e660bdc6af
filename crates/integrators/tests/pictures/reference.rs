//! Device images against the naive images of the CPU, sample by sample with the same random numbers.
//!
//! Both sides read the scene independently, so packing, textures, lights and scattering are all compared.
//! Rounding remains: a few paths take another turn where a random number falls next to a threshold, so most
//! pixels must agree closely and the means very closely.

use crate::pictures::common::{difference::*, scenes::*, *};
use glam::DVec3;
use rasray_gpu_scene::Sampling;
use rasray_integrators::{IntegratorSpec, Path, PathOptions};
use rasray_reference::shading::PosedScene;
use rasray_scene::{
    BackFaces, Camera, Environment, Instance, Light, Mesh, Projection, Sampler, Scene, ShadowTerminator,
};

/// Compares the images; at most a share of `deviating` of the pixels may differ.
fn compare(scene: &Scene, camera: &Camera, samples: u32, integrator: &IntegratorSpec, deviating: f64) {
    let found = difference(scene, scene, camera, samples, integrator);
    eprintln!("{}: {found:?}", scene.name);
    found.assert_within(deviating, 0.01, &scene.name);
}

#[test]
fn cornell_box() {
    let (scene, camera) = cornell();
    compare(&scene, &camera, 4, &path(4), 0.01);
    compare(&scene, &camera, 4, &occlusion(0.2), 0.01);
}

#[test]
fn independent_numbers_are_the_same_ones_too() {
    let (scene, camera) = cornell();
    let found = sampled_difference(&scene, &scene, &camera, 4, &path(4), Sampler::Pcg);
    found.assert_within(0.01, 0.01, "independent numbers");
}

#[test]
fn a_wrong_scene_is_noticed() {
    let (scene, camera) = cornell();
    let mut brighter = scene.clone();
    for material in &mut brighter.materials {
        material.base_color[0] *= 1.01;
    }
    let found = difference(&brighter, &scene, &camera, 4, &path(4));
    found.assert(found.share > 0.5, "more light is noticed");
    let mut lower = scene.clone();
    for instance in &mut lower.instances {
        instance.world_from_mesh.translation.y -= 0.01;
    }
    let found = difference(&lower, &scene, &camera, 8, &occlusion(0.2));
    found.assert(found.share > 0.1, "another shape is noticed");
}

#[test]
fn textures_masks_lights_and_an_environment_map() {
    let eye = forward_camera(DVec3::new(0.0, 0.2, 1.0));
    compare(&textured_room(), &eye, 4, &path(3), 0.01);
    compare(&textured_room(), &eye, 4, &occlusion(1.0), 0.01);
}

#[test]
fn glass_mirrors_and_blended_surfaces() {
    let eye = forward_camera(DVec3::new(0.0, 0.0, 0.9));
    compare(&glass_room(), &eye, 4, &path(5), 0.01);
}

#[test]
fn light_through_veils_and_panes() {
    let eye = forward_camera(DVec3::new(0.0, 0.0, 0.9));
    compare(&veiled_room(), &eye, 4, &path(3), 0.01);
    compare(&veiled_room(), &eye, 4, &opaque_panes(3), 0.01);
}

/// Rooms are looked into from outside, through walls without an outside and behind blended surfaces.
#[test]
fn backs_are_passed_by_the_rays_that_are_asked_to() {
    let eye = forward_camera(DVec3::new(0.1, 0.05, 2.6));
    let mut behind_a_veil = glass_room();
    let (number, veil) = (behind_a_veil.meshes.len(), 5);
    behind_a_veil.meshes.push(square(DVec3::Z * 1.5, DVec3::X * 0.5, DVec3::Y * 0.5, veil));
    let instance = behind_a_veil.instances[0].clone();
    behind_a_veil.instances.push(Instance { mesh: number, ..instance });
    for mut scene in [behind_a_veil, textured_room()] {
        scene.environment = Environment::Constant([0.3; 3]);
        for (number, material) in scene.materials.iter_mut().enumerate() {
            material.culls_back = number != 1;
        }
        let mirror = glam::DAffine3::from_scale(DVec3::new(1.0, -1.0, 1.0));
        // The walls stay.
        for instance in scene.instances.iter_mut().skip(6).step_by(2) {
            instance.world_from_mesh = mirror * instance.world_from_mesh;
        }
        for back_faces in BackFaces::ALL {
            for kind in [path(4), occlusion(1.0)] {
                let found = passing_difference([back_faces; 2], &scene, &eye, 4, &kind);
                eprintln!("{back_faces:?}: {found:?}");
                found.assert_within(0.01, 0.01, format_args!("{back_faces:?}"));
            }
            // The second room has no outer walls.
            let differs = |other: &&BackFaces| **other != back_faces && scene.name.contains("veil");
            let others = BackFaces::ALL.iter().filter(differs);
            for other in others {
                let found = passing_difference([*other, back_faces], &scene, &eye, 4, &path(4));
                found.assert(
                    found.share > 0.1,
                    format_args!("{other:?} in place of {back_faces:?} is noticed"),
                );
            }
        }
    }
}

/// A coarse smooth ball is under a sun from the side: the border of its shadow is that of a ball, not of its
/// triangles.
#[test]
fn a_coarse_ball_is_lit_as_a_ball() {
    let (columns, rows, albedo, irradiance) = (16, 9, 0.8, 2.0);
    let mut mesh = Mesh { name: "ball".to_owned(), ..Mesh::default() };
    for row in 0..=rows {
        for column in 0..columns {
            let polar = std::f64::consts::PI * f64::from(row) / f64::from(rows);
            let azimuth = std::f64::consts::TAU * f64::from(column) / f64::from(columns);
            let out = DVec3::new(polar.sin() * azimuth.cos(), polar.cos(), -polar.sin() * azimuth.sin());
            mesh.positions.push(out.as_vec3().to_array());
        }
    }
    mesh.normals = Some(mesh.positions.clone());
    for row in 0..rows as u32 {
        for column in 0..columns as u32 {
            let at = |row: u32, column: u32| row * columns as u32 + column % columns as u32;
            let [a, b] = [at(row, column), at(row, column + 1)];
            let [c, d] = [at(row + 1, column), at(row + 1, column + 1)];
            mesh.indices.extend([a, c, d, a, d, b]);
        }
    }
    let direction = DVec3::new(-0.9, -0.3, -0.2).normalize();
    let mut scene = scene(vec![mesh], vec![lambert(albedo, 0.0)], [0.0; 3]);
    scene.lights.push(Light::Directional { direction, irradiance: [irradiance; 3] });
    let device = device();
    let (side, half) = (64, 1.0_f32);
    let parallel = Projection::Orthographic { half_height: half };
    let eye = camera(DVec3::Z * 4.0, DVec3::X, DVec3::Y, parallel);
    let errors = ShadowTerminator::ALL.map(|shadow_terminator| {
        let mut stage = Setup::new(&device, &scene, eye.clone(), side, side, 3);
        let samples = 16;
        let sampling = Sampling { samples, ..Sampling::default() };
        stage.scene.set_sampling(sampling).expect("the frame can be written");
        let options = PathOptions { shadow_terminator, ..PathOptions::from(1) };
        let image = stage.render(&Path::new(&stage.desc(), options).expect("valid"), samples);
        let view = rasray_reference::shading::View {
            camera: eye.clone(),
            width: side,
            height: side,
            samples,
            seed: 3,
            sampler: Sampler::default(),
        };
        let posed = PosedScene::new(&scene, stage.scene.frame_origin()).expect("well formed");
        let naive = rasray_reference::integrators::PathOptions {
            shadow_terminator,
            ..rasray_reference::integrators::PathOptions::from(1)
        };
        let reference = posed.render_path(&view, naive).expect("valid");
        let differ = |(a, b): (&[f32; 3], &[f32; 3])| (a[0] - b[0]).abs() > 1.0e-3 * (b[0] + 1.0e-2);
        let differing = image.iter().zip(&reference.pixels).filter(|&pair| differ(pair)).count();
        assert!(differing * 100 <= image.len(), "{shadow_terminator:?}: {differing} pixels differ");
        // The pixels are those where light grazes, away from the silhouette.
        let brightest = f64::from(albedo * irradiance) / std::f64::consts::PI;
        let band = (0..side * side).filter_map(|pixel| {
            let place =
                |index: u32| (2.0 * (f64::from(index) + 0.5) / f64::from(side) - 1.0) * f64::from(half);
            let (x, y) = (place(pixel % side), -place(pixel / side));
            let normal = DVec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt());
            let cosine = normal.dot(-direction);
            let is_in_band = x * x + y * y < 0.7 && cosine.abs() < 0.3;
            let error = f64::from(image[pixel as usize][0]) - brightest * cosine.max(0.0);
            is_in_band.then_some(error.abs() / brightest)
        });
        let errors: Vec<f64> = band.collect();
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        let largest = errors.iter().copied().fold(0.0, f64::max);
        eprintln!(
            "{shadow_terminator:?}: {mean} of the brightest, at most {largest}, {} pixels",
            errors.len()
        );
        [mean, largest]
    });
    assert_silent(&device);
    let [[mean, largest], [mean_offset, largest_offset]] = errors;
    assert!(largest > 0.1, "the triangles show: {errors:?}");
    assert!(largest_offset < 0.02 && mean_offset < 0.5 * mean, "they do not: {errors:?}");
}

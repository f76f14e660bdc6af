//! Bounds, default camera and default light.

use approx::assert_abs_diff_eq;
use glam::{DAffine3, DVec3};
use proptest::prelude::*;
use rasray_scene::default_view::{bounds, camera_looking_at, default_camera, ensure_lit, is_lit};
use rasray_scene::{Environment, Instance, Light, Material, Mesh, Projection, Scene};

use crate::made::scene;

fn triangle_scene(points: [[f32; 3]; 3], world_from_mesh: DAffine3) -> Scene {
    let positions = [points.to_vec(), vec![[1.0e6, 1.0e6, 1.0e6]]].concat();
    Scene {
        meshes: vec![Mesh { positions, indices: vec![0, 1, 2], ..Mesh::default() }],
        instances: vec![Instance { name: "triangle".to_owned(), mesh: 0, world_from_mesh }],
        materials: vec![Material::default()],
        ..Scene::default()
    }
}

#[test]
fn bounds_follow_instances_and_leave_out_unused_vertices() {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let place = DAffine3::from_translation(DVec3::new(1.0e9, 0.0, 0.5));
    let scene = triangle_scene(points, place);
    assert_eq!(bounds(&scene), Some((DVec3::new(1.0e9, 0.0, 0.5), DVec3::new(1.0e9 + 1.0, 1.0, 0.5))));
    assert_eq!(bounds(&Scene::default()), None);
    let mut unplaced = scene;
    unplaced.instances.clear();
    assert_eq!(bounds(&unplaced), None);
}

#[test]
fn cameras_look_where_they_are_told() {
    let eye = DVec3::new(1.0, 2.0, 3.0);
    for target in [DVec3::ZERO, DVec3::new(1.0, 9.0, 3.0), DVec3::new(1.0, -9.0, 3.0), eye] {
        let camera = camera_looking_at("camera", eye, target, 0.5);
        let frame = camera.world_from_camera.matrix3;
        assert_abs_diff_eq!(frame.determinant(), 1.0, epsilon = 1.0e-12);
        let forward = (target - eye).normalize_or(DVec3::NEG_Z);
        assert!((-frame.z_axis).distance(forward) < 1.0e-12);
        assert!(frame.y_axis.y >= 0.0, "upright");
    }
}

#[test]
fn what_does_not_emit_gets_light_once() {
    let mut scene = triangle_scene([[0.0; 3]; 3], DAffine3::IDENTITY);
    assert!(!is_lit(&scene));
    assert!(ensure_lit(&mut scene));
    assert!(matches!(scene.environment, Environment::LatLong { .. }));
    assert_eq!(scene.warnings[0].kind, "default-light");
    assert!(!ensure_lit(&mut scene), "it is lit now");
    assert_eq!(scene.warnings.len(), 1);

    let lit = |change: &dyn Fn(&mut Scene)| {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let mut scene = triangle_scene(corners, DAffine3::IDENTITY);
        change(&mut scene);
        is_lit(&scene)
    };
    assert!(lit(&|scene| scene.materials[0].emission = [0.0, 0.1, 0.0]));
    assert!(lit(&|scene| scene.materials[0].unlit = true));
    assert!(lit(&|scene| scene
        .lights
        .push(Light::Directional { direction: DVec3::NEG_Y, irradiance: [1.0; 3] })));
    assert!(lit(&|scene| scene.environment =
        Environment::LatLong { width: 1, height: 1, radiance: vec![[0.0, 0.0, 1.0]] }));
    assert!(!lit(&|scene| {
        scene.materials[0].emission = [1.0; 3];
        scene.instances.clear();
    }));
}

#[test]
fn the_default_camera_stands_outside_of_built_in_scenes() {
    let scene = scene("spheres:10k");
    let camera = default_camera(&scene);
    let (low, high) = bounds(&scene).expect("bounds");
    let eye = camera.world_from_camera.translation;
    assert!(!(eye.cmpgt(low).all() && eye.cmplt(high).all()));
}

#[test]
fn a_scene_without_triangles_has_a_default_camera() {
    assert!(default_camera(&Scene::default()).world_from_camera.is_finite());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    /// Every corner of the bounds is in a square picture of the default camera, at any scale and place.
    #[test]
    fn the_default_camera_sees_everything(
        corner in prop::array::uniform3(-1.0_f32..1.0),
        size in prop::array::uniform3(0.0_f32..1.0),
        scale in -6_i32..7,
        shift in -1.0e5_f64..1.0e5,
    ) {
        let far = [0, 1, 2].map(|axis| corner[axis] + size[axis]);
        let place = DAffine3::from_scale(DVec3::splat(10.0_f64.powi(scale)));
        let place = DAffine3::from_translation(DVec3::splat(shift * 10.0_f64.powi(scale))) * place;
        let scene = triangle_scene([corner, far, corner], place);
        let camera = default_camera(&scene);
        let Projection::Perspective { fov_y } = camera.projection else { panic!("perspective") };
        let camera_from_world = camera.world_from_camera.inverse();
        let (low, high) = bounds(&scene).expect("bounds");
        for bits in 0..8 {
            let pick = |axis: usize| if bits >> axis & 1 == 1 { high[axis] } else { low[axis] };
            let seen = camera_from_world.transform_point3(DVec3::new(pick(0), pick(1), pick(2)));
            prop_assert!(seen.z < 0.0);
            let half = f64::from(fov_y / 2.0).tan() * -seen.z * (1.0 + 1.0e-6);
            prop_assert!(seen.x.abs() <= half && seen.y.abs() <= half, "{seen}");
        }
    }
}

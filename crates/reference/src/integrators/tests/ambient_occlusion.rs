use glam::Vec3;

use crate::{
    shading::PosedScene,
    testing::{assert_mean, diffuse, parallel_view, quad, scene, sphere, view},
};

fn floor() -> rasray_scene::Mesh {
    quad(Vec3::new(-50.0, 0.0, 50.0), Vec3::X * 100.0, Vec3::NEG_Z * 100.0, 0)
}

/// Returns the ambient light at a point of a plane, at `distance` from the point where a sphere of radius 1
/// touches the plane.
fn next_to_sphere(distance: f64) -> f64 {
    1.0 - (1.0 + distance * distance).powf(-1.5)
}

#[test]
fn visibility_next_to_a_sphere_has_its_closed_form() {
    let mut ball = sphere(5, false, false, 0);
    // Inscribed facets are a little inside the sphere; scaling moves half of the deviation outside.
    ball.positions.iter_mut().for_each(|p| *p = [p[0] * 1.0003, p[1] * 1.0003 + 1.0, p[2] * 1.0003]);
    let scene = scene(vec![diffuse(0.5)], vec![floor(), ball]);
    let posed = PosedScene::new(&scene, glam::DVec3::ZERO).expect("valid");
    for distance in [0.5, 1.0, 2.0] {
        // The eye looks from low at the side, so that the sphere does not hide the point.
        let eye = [distance + 10.0 * 0.94, 10.0 * 0.342, 0.0];
        let view = parallel_view(eye, [distance, 0.0, 0.0], 1.0e-3, 16, 96);
        let image = posed.render_ambient_occlusion(&view, f32::INFINITY).expect("rendered");
        assert_mean(&image, next_to_sphere(distance), 0.002, 0.1);
    }
}

#[test]
fn a_plane_does_not_occlude_itself_at_any_distance_from_the_origin() {
    let scene = scene(vec![diffuse(0.5)], vec![floor()]);
    let posed = PosedScene::new(&scene, glam::DVec3::new(0.0, -1.0e4, 3.0e4)).expect("valid");
    let view = view([0.0, 0.3, 30.0], [0.0, 0.0, 0.0], 16, 16);
    let image = posed.render_ambient_occlusion(&view, f32::INFINITY).expect("rendered");
    assert!(image.pixels.iter().flatten().all(|value| *value == 1.0));
}

#[test]
fn a_long_wall_hides_its_share_and_only_within_range() {
    let wall = quad(Vec3::new(0.0, 0.0, -500.0), Vec3::Z * 1000.0, Vec3::Y, 0);
    let scene = scene(vec![diffuse(0.5)], vec![floor(), wall]);
    let posed = PosedScene::new(&scene, glam::DVec3::ZERO).expect("valid");
    let view = parallel_view([1.0, 5.0, 0.0], [1.0, 0.0, 0.0], 1.0e-3, 16, 64);
    // The occluded share is (1 - x / sqrt(x^2 + h^2)) / 2 at x = h = 1.
    let image = posed.render_ambient_occlusion(&view, f32::INFINITY).expect("rendered");
    assert_mean(&image, 1.0 - 0.146_447, 0.0, 0.02);
    let near = posed.render_ambient_occlusion(&view, 0.999).expect("rendered");
    assert!(near.pixels.iter().flatten().all(|value| *value == 1.0));
}

#[test]
fn the_background_is_one() {
    let scene = scene(vec![diffuse(0.5)], Vec::new());
    let image = crate::integrators::render_ambient_occlusion(
        &scene,
        &view([0.0; 3], [0.0, 0.0, -1.0], 1, 1).camera,
        4,
        3,
        2,
        7,
        1.0,
    )
    .expect("rendered");
    assert_eq!((image.width, image.height), (4, 3));
    assert!(image.pixels.iter().flatten().all(|value| *value == 1.0));
}

//! Which camera looks at the scene.

use crate::arguments::ViewArguments;
use crate::error::AppError;
use glam::DVec3;
use rasray_experiment::{Chosen, default_view, named_view};
use rasray_scene::Scene;
use rasray_scene::default_view::camera_looking_at;

/// Full vertical angle of view with `--eye`, degrees, unless told.
const DEFAULT_FOV: f64 = 45.0;

/// The camera that was asked for; else [`default_view`].
///
/// # Errors
/// A camera that the scene lacks, and an eye at its own target.
pub(crate) fn choose(scene: &Scene, view: &ViewArguments) -> Result<Chosen, AppError> {
    if let (Some(eye), Some(target)) = (view.eye, view.target) {
        let (eye, target) = (DVec3::from_array(eye), DVec3::from_array(target));
        let distance = (target - eye).length();
        if !(distance > 0.0 && distance.is_finite()) {
            return Err(AppError::usage(
                "--eye and --target give no direction to look in",
                "choose a --target at another place than --eye",
            ));
        }
        let fov = view.fov.unwrap_or(DEFAULT_FOV).to_radians() as f32;
        return Ok(Chosen { camera: camera_looking_at("command line", eye, target, fov), index: None });
    }
    match &view.camera {
        Some(name) => Ok(named_view(scene, name)?),
        None => Ok(default_view(scene)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::described;
    use rasray_scene::Projection;

    fn scene(names: &[&str]) -> Scene {
        let camera = |name: &&str| camera_looking_at(name, DVec3::X, DVec3::ZERO, 0.5);
        Scene { cameras: names.iter().map(camera).collect(), ..Default::default() }
    }

    fn view(camera: &str) -> ViewArguments {
        ViewArguments { camera: Some(camera.to_owned()), ..Default::default() }
    }

    #[test]
    fn names_go_before_positions() {
        let scene = scene(&["1", "door"]);
        assert_eq!(choose(&scene, &view("door")).expect("by name").camera.name, "door");
        assert_eq!(choose(&scene, &view("1")).expect("by name").camera.name, "1");
        assert_eq!(choose(&scene, &view("0")).expect("by position").camera.name, "1");
        assert_eq!(choose(&scene, &ViewArguments::default()).expect("the first").camera.name, "1");
        let error = choose(&scene, &view("window")).expect_err("no such camera");
        assert!(error.help().contains("'door'"), "{}", error.help());
    }

    #[test]
    fn an_eye_looks_at_its_target() {
        let view = ViewArguments { eye: Some([0.0, 0.0, 5.0]), target: Some([0.0; 3]), ..Default::default() };
        let camera = choose(&scene(&[]), &view).expect("a camera").camera;
        let forward = camera.world_from_camera.transform_vector3(DVec3::NEG_Z);
        assert!((forward - DVec3::NEG_Z).length() < 1.0e-12);
        let Projection::Perspective { fov_y } = camera.projection else { panic!("perspective") };
        assert!((fov_y - 45.0_f32.to_radians()).abs() < 1.0e-6);
        let still = ViewArguments { eye: Some([1.0; 3]), target: Some([1.0; 3]), ..Default::default() };
        assert_eq!(choose(&scene(&[]), &still).expect_err("no direction").exit_code(), 2);
    }

    #[test]
    fn a_camera_in_words_is_the_options_that_make_it() {
        let eye = DVec3::new(1.5, -0.001_234_56, 30.0);
        let camera = camera_looking_at("front", eye, DVec3::new(-2.0, 0.25, 1.0), 0.5);
        let scene = Scene { cameras: vec![camera.clone()], ..Scene::default() };
        let chosen = choose(&scene, &ViewArguments::default()).expect("the first");
        let text = described(&chosen.record());
        let words: Vec<_> = text.split_whitespace().collect();
        let ["0", "'front',", "--eye", eye, "--target", target, "--fov", fov] = words[..] else {
            panic!("{text}")
        };
        let point = |text: &str| Some(crate::arguments::values::point(text).expect("a point"));
        let fov = Some(fov.parse().expect("degrees"));
        let view = ViewArguments { eye: point(eye), target: point(target), fov, ..Default::default() };
        let again = choose(&scene, &view).expect("a camera").camera;
        assert!(again.world_from_camera.abs_diff_eq(camera.world_from_camera, 1.0e-3), "{text}");
        assert_eq!(chosen.record().index, Some(0));

        let mut rolled = chosen;
        rolled.camera.world_from_camera.matrix3 *= glam::DMat3::from_rotation_z(0.1);
        assert!(described(&rolled.record()).ends_with("rolled"));
        rolled.camera.projection = Projection::Orthographic { half_height: 1.25 };
        assert!(described(&rolled.record()).contains("2.5 m high"));
    }
}

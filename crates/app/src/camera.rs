//! Which camera looks at the scene.

use crate::arguments::ViewArguments;
use crate::error::AppError;
use glam::DVec3;
use rasray_scene::default_view::{camera_looking_at, default_camera};
use rasray_scene::{Camera, Scene};

/// Full vertical angle of view with `--eye`, degrees, unless told.
const DEFAULT_FOV: f64 = 45.0;

/// The camera that was asked for; else the scene's first; else one that
/// stands in the room that the scene is, or outside and sees all of it.
///
/// # Errors
/// A camera that the scene lacks, and an eye at its own target.
pub fn choose(scene: &Scene, view: &ViewArguments) -> Result<Camera, AppError> {
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
        return Ok(camera_looking_at("command line", eye, target, fov));
    }
    if let Some(name) = &view.camera {
        return named(scene, name);
    }
    Ok(scene.cameras.first().cloned().unwrap_or_else(|| default_camera(scene)))
}

fn named(scene: &Scene, name: &str) -> Result<Camera, AppError> {
    let by_name = scene.cameras.iter().find(|camera| camera.name == name);
    let by_position = || name.parse::<usize>().ok().and_then(|position| scene.cameras.get(position));
    by_name.or_else(by_position).cloned().ok_or_else(|| {
        let known: Vec<_> =
            scene.cameras.iter().enumerate().map(|(i, camera)| format!("{i} '{}'", camera.name)).collect();
        let help = if known.is_empty() {
            "the scene has no cameras; use --eye and --target".to_owned()
        } else {
            format!("its cameras: {}", known.join(", "))
        };
        AppError::usage(format!("the scene {} has no camera '{name}'", scene.name), help)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
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
        assert_eq!(choose(&scene, &view("door")).expect("by name").name, "door");
        assert_eq!(choose(&scene, &view("1")).expect("by name").name, "1");
        assert_eq!(choose(&scene, &view("0")).expect("by position").name, "1");
        assert_eq!(choose(&scene, &ViewArguments::default()).expect("the first").name, "1");
        let error = choose(&scene, &view("window")).expect_err("no such camera");
        assert!(error.help().contains("'door'"), "{}", error.help());
    }

    #[test]
    fn an_eye_looks_at_its_target() {
        let view = ViewArguments { eye: Some([0.0, 0.0, 5.0]), target: Some([0.0; 3]), ..Default::default() };
        let camera = choose(&scene(&[]), &view).expect("a camera");
        let forward = camera.world_from_camera.transform_vector3(DVec3::NEG_Z);
        assert!((forward - DVec3::NEG_Z).length() < 1.0e-12);
        let Projection::Perspective { fov_y } = camera.projection else { panic!("perspective") };
        assert!((fov_y - 45.0_f32.to_radians()).abs() < 1.0e-6);
        let still = ViewArguments { eye: Some([1.0; 3]), target: Some([1.0; 3]), ..Default::default() };
        assert_eq!(choose(&scene(&[]), &still).expect_err("no direction").exit_code(), 2);
    }
}

//! Choice of the camera that looks at a scene.

use crate::error::LoadError;
use glam::DVec3;
use rasray_report::CameraRecord;
use rasray_scene::default_view::{camera_looking_at, default_camera};
use rasray_scene::{Camera, Lens, Projection, Scene};

/// Default full vertical angle of view of a placed camera, degrees.
const DEFAULT_FOV: f64 = 45.0;

/// Camera with its origin: one of the scene's cameras, or a placed or default one.
#[derive(Clone, Debug)]
pub struct ChosenCamera {
    /// The camera.
    pub camera: Camera,
    /// Index among the scene's cameras, if the camera is one of them.
    pub index: Option<usize>,
}

impl ChosenCamera {
    /// Adds a lens to this camera: the diameter of its opening, metres (0: a pinhole), and the distance of
    /// the plane in focus, metres along the view.
    ///
    /// # Errors
    /// An error for a parallel projection, or for a lens without a distance.
    pub fn with_lens(mut self, aperture: f64, focus: Option<f64>) -> Result<Self, LoadError> {
        let aperture = aperture as f32;
        self.camera.lens = match (self.camera.projection, focus) {
            _ if aperture <= 0.0 => None,
            (Projection::Orthographic { .. }, _) => {
                return Err(LoadError::ParallelLens { camera: self.described() });
            }
            (Projection::Perspective { .. }, None) => return Err(LoadError::NoFocus),
            (Projection::Perspective { .. }, Some(focus)) => Some(Lens { aperture, focus: focus as f32 }),
        };
        Ok(self)
    }

    /// Returns the record of the camera in reports.
    pub fn record(&self) -> CameraRecord {
        let frame = &self.camera.world_from_camera;
        let (kind, fov_y_degrees, height_m) = match self.camera.projection {
            Projection::Perspective { fov_y } => ("perspective", Some(f64::from(fov_y).to_degrees()), None),
            Projection::Orthographic { half_height } => {
                ("orthographic", None, Some(2.0 * f64::from(half_height)))
            }
        };
        CameraRecord {
            name: self.camera.name.clone(),
            index: self.index.map(|index| index as u64),
            kind: kind.to_owned(),
            fov_y_degrees,
            height_m,
            aspect_ratio: self.camera.aspect_ratio.map(f64::from),
            aperture_m: self.camera.lens.map(|lens| f64::from(lens.aperture)),
            focus_m: self.camera.lens.map(|lens| f64::from(lens.focus)),
            eye: frame.translation.to_array(),
            forward: (-frame.matrix3.z_axis).normalize_or_zero().to_array(),
            up: frame.matrix3.y_axis.normalize_or_zero().to_array(),
        }
    }

    /// Describes the camera in a few words: its origin, its position, and the options of the command that
    /// place the same camera.
    pub fn described(&self) -> String {
        let record = self.record();
        let whose = match record.index {
            Some(index) => format!("{index} '{}'", record.name),
            None => record.name.clone(),
        };
        let frame = record.aspect_ratio.map(|ratio| format!(", framing {}:1", short(ratio)));
        let lens = self
            .camera
            .lens
            .map(|Lens { aperture, focus }| format!(" --aperture {aperture} --focus {focus}"));
        format!("{whose}, {}{}{}", place(&record), lens.unwrap_or_default(), frame.unwrap_or_default())
    }
}

/// Returns the default view: the scene's first camera. Without one the camera stands in the room that the
/// scene is, or outside and sees all of the scene.
pub fn default_view(scene: &Scene) -> ChosenCamera {
    let first = scene.cameras.first().cloned().map(|camera| ChosenCamera { camera, index: Some(0) });
    first.unwrap_or_else(|| ChosenCamera { camera: default_camera(scene), index: None })
}

/// Returns the camera of a scene by name, else by index from 0.
///
/// # Errors
/// An error if the scene has no such camera.
pub fn named_view(scene: &Scene, name: &str) -> Result<ChosenCamera, LoadError> {
    let by_name = scene.cameras.iter().position(|camera| camera.name == name);
    let by_position = || name.parse::<usize>().ok().filter(|position| *position < scene.cameras.len());
    let index = by_name.or_else(by_position).ok_or_else(|| LoadError::NoSuchCamera {
        scene: scene.name.clone(),
        wanted: name.to_owned(),
        cameras: scene.cameras.iter().map(|camera| camera.name.clone()).collect(),
    })?;
    Ok(ChosenCamera { camera: scene.cameras[index].clone(), index: Some(index) })
}

/// Places a camera at `eye` that looks at `target` (metres), upright; `fov` is the full vertical angle of
/// view in degrees.
///
/// # Errors
/// An error if both points coincide, or are not finite.
pub fn placed_view(eye: [f64; 3], target: [f64; 3], fov: Option<f64>) -> Result<ChosenCamera, LoadError> {
    let (eye, target) = (DVec3::from_array(eye), DVec3::from_array(target));
    let distance = (target - eye).length();
    if !(distance > 0.0 && distance.is_finite()) {
        return Err(LoadError::NoDirection);
    }
    let fov = fov.unwrap_or(DEFAULT_FOV).to_radians() as f32;
    Ok(ChosenCamera { camera: camera_looking_at("command line", eye, target, fov), index: None })
}

/// Describes the projection and position of a camera. A perspective camera is described by the options that
/// make the same one, unless it is rolled.
fn place(record: &CameraRecord) -> String {
    let (eye, forward) = (DVec3::from_array(record.eye), DVec3::from_array(record.forward));
    // A target as far away as the eye is from the origin keeps as many digits.
    let target = eye + forward * eye.length().max(1.0);
    let point = |point: DVec3| point.to_array().map(short).join(",");
    match (record.fov_y_degrees, record.height_m) {
        (Some(fov), _) => {
            let upright = camera_looking_at("", eye, target, 1.0).world_from_camera.matrix3.y_axis;
            let rolled =
                if upright.dot(DVec3::from_array(record.up)) < 0.999_99 { ", and rolled" } else { "" };
            format!("--eye {} --target {} --fov {}{rolled}", point(eye), point(target), short(fov))
        }
        (_, height) => format!(
            "parallel, {} m high, from {} towards {}",
            short(height.unwrap_or_default()),
            point(eye),
            point(target)
        ),
    }
}

/// Formats a number with at most three digits after the point, or in powers of ten.
fn short(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude != 0.0 && !(1.0e-2..1.0e7).contains(&magnitude) && magnitude >= 1.0e-12 {
        return format!("{value:.4e}");
    }
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(names: &[&str]) -> Scene {
        let camera = |name: &&str| camera_looking_at(name, DVec3::X, DVec3::ZERO, 0.5);
        Scene { cameras: names.iter().map(camera).collect(), ..Default::default() }
    }

    #[test]
    fn names_go_before_positions() {
        let scene = scene(&["1", "door"]);
        let named = |name: &str| named_view(&scene, name).expect("a camera").camera.name;
        assert_eq!(["door", "1", "0"].map(named), ["door", "1", "1"]);
        assert_eq!(default_view(&scene).camera.name, "1");
        let error = named_view(&scene, "window").expect_err("no such camera");
        assert!(
            matches!(&error, LoadError::NoSuchCamera { cameras, .. } if *cameras == ["1", "door"]),
            "{error:?}"
        );
    }

    #[test]
    fn an_eye_looks_at_its_target() {
        let camera = placed_view([0.0, 0.0, 5.0], [0.0; 3], None).expect("a camera").camera;
        let forward = camera.world_from_camera.transform_vector3(DVec3::NEG_Z);
        assert!((forward - DVec3::NEG_Z).length() < 1.0e-12);
        let Projection::Perspective { fov_y } = camera.projection else { panic!("perspective") };
        assert!((fov_y - 45.0_f32.to_radians()).abs() < 1.0e-6);
        let error = placed_view([1.0; 3], [1.0; 3], None).expect_err("no direction");
        assert!(matches!(error, LoadError::NoDirection), "{error:?}");
    }

    #[test]
    fn a_lens_needs_a_perspective_and_a_distance() {
        let pinhole = placed_view([0.0, 0.0, 5.0], [0.0; 3], None).expect("a camera");
        let open = pinhole.clone().with_lens(0.05, Some(4.5)).expect("a lens");
        assert_eq!(open.camera.lens, Some(Lens { aperture: 0.05, focus: 4.5 }));
        assert!(open.described().ends_with("--fov 45 --aperture 0.05 --focus 4.5"), "{}", open.described());
        assert_eq!(open.record().focus_m, Some(4.5));
        assert_eq!(pinhole.clone().with_lens(0.0, None).expect("a pinhole").camera.lens, None);
        let mut parallel = pinhole.clone();
        parallel.camera.projection = Projection::Orthographic { half_height: 1.0 };
        let error = pinhole.with_lens(0.1, None).expect_err("nothing is in focus");
        assert!(matches!(error, LoadError::NoFocus), "{error:?}");
        let error = parallel.with_lens(0.1, Some(1.0)).expect_err("no lens");
        assert!(matches!(error, LoadError::ParallelLens { .. }), "{error:?}");
    }

    #[test]
    fn a_camera_in_words_is_the_options_that_make_it() {
        let eye = DVec3::new(1.5, -0.001_234_56, 30.0);
        let camera = camera_looking_at("front", eye, DVec3::new(-2.0, 0.25, 1.0), 0.5);
        let chosen = default_view(&Scene { cameras: vec![camera.clone()], ..Scene::default() });
        let text = chosen.described();
        let words: Vec<_> = text.split_whitespace().collect();
        let ["0", "'front',", "--eye", eye, "--target", target, "--fov", fov] = words[..] else {
            panic!("{text}")
        };
        let point = |text: &str| -> [f64; 3] {
            let numbers: Vec<f64> = text.split(',').map(|number| number.parse().expect("a number")).collect();
            numbers.try_into().expect("three of them")
        };
        let fov = Some(fov.parse().expect("degrees"));
        let again = placed_view(point(eye), point(target), fov).expect("a camera").camera;
        assert!(again.world_from_camera.abs_diff_eq(camera.world_from_camera, 1.0e-3), "{text}");
        assert_eq!(chosen.record().index, Some(0));

        let mut rolled = chosen;
        rolled.camera.world_from_camera.matrix3 *= glam::DMat3::from_rotation_z(0.1);
        assert!(rolled.described().ends_with("rolled"));
        rolled.camera.projection = Projection::Orthographic { half_height: 1.25 };
        assert!(rolled.described().contains("2.5 m high"));
    }
}

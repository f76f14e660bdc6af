//! Which camera looks at a scene.

use crate::error::ExperimentError;
use rasray_report::CameraRecord;
use rasray_scene::default_view::default_camera;
use rasray_scene::{Camera, Projection, Scene};

/// A camera, and whose it is.
#[derive(Clone, Debug)]
pub struct Chosen {
    /// The camera.
    pub camera: Camera,
    /// Its position among the scene's cameras, if it is one of them.
    pub index: Option<usize>,
}

impl Chosen {
    /// What reports say of it.
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
            eye: frame.translation.to_array(),
            forward: (-frame.matrix3.z_axis).normalize_or_zero().to_array(),
            up: frame.matrix3.y_axis.normalize_or_zero().to_array(),
        }
    }
}

/// The view where nothing is said of it: the scene's first camera; else one that stands in the room that the scene
/// is, or outside and sees all of it.
pub fn default_view(scene: &Scene) -> Chosen {
    let first = scene.cameras.first().cloned().map(|camera| Chosen { camera, index: Some(0) });
    first.unwrap_or_else(|| Chosen { camera: default_camera(scene), index: None })
}

/// The camera of a scene by name, else by position from 0.
///
/// # Errors
/// The scene has no such camera.
pub fn named_view(scene: &Scene, name: &str) -> Result<Chosen, ExperimentError> {
    let by_name = scene.cameras.iter().position(|camera| camera.name == name);
    let by_position = || name.parse::<usize>().ok().filter(|position| *position < scene.cameras.len());
    let index = by_name.or_else(by_position).ok_or_else(|| {
        let known: Vec<_> =
            scene.cameras.iter().enumerate().map(|(i, camera)| format!("{i} '{}'", camera.name)).collect();
        let help = if known.is_empty() {
            "the scene has no cameras; use --eye and --target".to_owned()
        } else {
            format!("its cameras: {}", known.join(", "))
        };
        ExperimentError::usage(format!("the scene {} has no camera '{name}'", scene.name), help)
    })?;
    Ok(Chosen { camera: scene.cameras[index].clone(), index: Some(index) })
}

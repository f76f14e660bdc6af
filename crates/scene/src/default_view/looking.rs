//! Cameras given by an eye and a target.

use glam::{DAffine3, DMat3, DVec3};

use crate::{Camera, Projection};

/// Makes a perspective camera at `eye` (metres) that looks at `target`, upright; `fov_y` is the full vertical
/// angle in radians. Looking straight up or down, -z is up in the picture. If eye and target coincide, the
/// camera looks along -z.
pub fn camera_looking_at(name: &str, eye: DVec3, target: DVec3, fov_y: f32) -> Camera {
    let back = (eye - target).normalize_or(DVec3::Z);
    let right = DVec3::Y.cross(back).try_normalize().unwrap_or(DVec3::X);
    let up = back.cross(right);
    Camera {
        name: name.to_owned(),
        world_from_camera: DAffine3::from_mat3_translation(DMat3::from_cols(right, up, back), eye),
        projection: Projection::Perspective { fov_y },
        aspect_ratio: None,
        lens: None,
    }
}

//! Cameras in words.

use glam::DVec3;
use rasray_report::CameraRecord;
use rasray_scene::default_view::camera_looking_at;

/// A camera in a few words: whose it is, where it stands, and the options that put one there.
pub(crate) fn described(record: &CameraRecord) -> String {
    let whose = match record.index {
        Some(index) => format!("{index} '{}'", record.name),
        None => record.name.clone(),
    };
    format!("{whose}, {}", placed(record))
}

/// Projection and place of a camera; of a perspective as the options that make the same one, unless it is rolled.
fn placed(record: &CameraRecord) -> String {
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

/// A number with at most three digits after the point, or in powers of ten.
fn short(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude != 0.0 && !(1.0e-2..1.0e7).contains(&magnitude) && magnitude >= 1.0e-12 {
        return format!("{value:.4e}");
    }
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

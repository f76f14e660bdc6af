//! Default camera, light and material of scenes that have none of their own; and bounds of scenes.

use glam::DVec3;

use crate::{Camera, Material, Scene};

mod bounds;
mod emission;
mod emitters;
mod light;
mod looking;
mod room;
mod seen;
mod sight;
mod sky;

pub use bounds::bounds;
pub use emitters::emits;
pub use light::{add_default_light, default_light, ensure_lit, is_lit, is_lit_at_times};
pub use looking::camera_looking_at;
pub(crate) use seen::seen_instances;

/// Full vertical angle of the default camera that stands outside, radians.
const FOV_Y: f64 = 0.8;
/// Ratio of the picture's extent to the extent of the scene's bounds.
const MARGIN: f64 = 1.05;

/// Makes a camera for a scene that has none, upright with +y; the same scene always gets the same camera.
///
/// The camera stands outside and sees the whole scene from the front, somewhat to the right and above, in a
/// picture that is at least as wide as high; it looks at the origin if the scene has no triangles. Two kinds
/// of scene are seen in another way:
///
/// - A room with one open side is looked into from before that side. A scene is a room if most of the
///   surfaces seen from its middle turn their front (counter-clockwise) side there and nothing is close; a
///   solid turns its back to its own inside.
/// - In a room that is closed on all sides, but perhaps above, the camera stands inside: clear of the walls,
///   looking along the longest free way, almost level, with a vertical angle of 60 to 70 degrees. Less than
///   about two fifths of the surface may lie outside; so a hollow object with walls of its own, such as a
///   helmet, is no room, and neither is a house as large outside as inside.
///
/// Scenes of more than 2^23 triangles are not examined.
pub fn default_camera(scene: &Scene) -> Camera {
    room::camera_inside(scene).unwrap_or_else(|| camera_outside(scene))
}

fn camera_outside(scene: &Scene) -> Camera {
    let (low, high) = bounds(scene).unwrap_or((DVec3::NEG_ONE, DVec3::ONE));
    let (centre, half) = (low * 0.5 + high * 0.5, high * 0.5 - low * 0.5);
    let direction = DVec3::new(0.45, 0.35, 1.0).normalize();
    let toward = camera_looking_at("default", centre + direction, centre, FOV_Y as f32);
    let axes = toward.world_from_camera.matrix3;
    // The distance from which a corner of the bounds is still in the picture. Bounds that are as thin as the
    // view's axis keep their distance.
    let needed = |corner: DVec3| {
        let aside = axes.x_axis.dot(corner).abs().max(axes.y_axis.dot(corner).abs()).max(0.1 * half.length());
        axes.z_axis.dot(corner) + MARGIN * aside / (FOV_Y * 0.5).tan()
    };
    let corner =
        |bits: u32| half * DVec3::from([0, 1, 2].map(|axis| f64::from(bits >> axis & 1) * 2.0 - 1.0));
    // A point or a speck still gets a picture with a scale.
    let least = (centre.abs().max_element() * 1.0e-6).max(1.0e-6);
    let distance = (0..8).map(|bits| needed(corner(bits))).fold(least, f64::max);
    camera_looking_at("default", centre + direction * distance, centre, FOV_Y as f32)
}

/// Makes the material of triangles whose file names none: light grey, rough, no metal.
pub fn plain_material(name: &str) -> Material {
    Material { name: name.to_owned(), base_color: [0.8, 0.8, 0.8, 1.0], metallic: 0.0, ..Material::default() }
}

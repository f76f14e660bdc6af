//! `KHR_lights_punctual`: lights of the nodes, in the world.

use std::f32::consts::FRAC_PI_2;

use ::gltf::json::extensions::scene::khr_lights_punctual::{Light as JsonLight, Spot, Type};
use ::gltf::json::validation::Checked;
use glam::DVec3;

use super::document::Document;
use super::hierarchy::Hierarchy;
use super::punctual;
use rasray_scene::Light;
use rasray_scene::pose::light_direction;

/// Returns the lights of the nodes in `order`, each with its node. Scale moves a light but changes neither
/// its brightness nor its range.
pub(super) fn place(document: &Document<'_>, hierarchy: &Hierarchy, order: &[usize]) -> Vec<(usize, Light)> {
    let mut lights = Vec::new();
    for &node in order {
        let extensions = document.root.nodes[node].extensions.as_ref();
        let Some(reference) = extensions.and_then(|found| found.khr_lights_punctual.as_ref()) else {
            continue;
        };
        let source = &punctual::lights(&document.root)[reference.light.value()];
        let world = hierarchy.world[node];
        match light(source, world.translation, light_direction(world)) {
            Some(light) => {
                remark(document, reference.light.value(), source);
                lights.push((node, light));
            }
            None => {
                let text = match source.type_ {
                    Checked::Invalid => {
                        let light = reference.light.value();
                        let place = format!("extensions.KHR_lights_punctual.lights[{light}].type");
                        format!("the type of its light {}; it was dropped", document.unknown(&place))
                    }
                    Checked::Valid(_) => {
                        "its light has no direction, cone, or finite place and intensity; it was dropped"
                            .to_owned()
                    }
                };
                document.note("bad-light", format!("nodes[{node}]"), text);
            }
        }
    }
    lights
}

/// Notes remarks on values of a light that were brought into range.
fn remark(document: &Document<'_>, index: usize, source: &JsonLight) {
    let place = format!("lights[{index}]");
    if source.color.iter().any(|x| x * source.intensity < 0.0) {
        let text = format!(
            "color {:?} times intensity {} is negative, and taken as 0",
            source.color, source.intensity
        );
        document.note("light-range", &place, text);
    }
    if let Some(range) = source.range.filter(|range| *range <= 0.0) {
        document.note("light-range", &place, format!("range {range} is not above 0, and taken as unlimited"));
    }
    if let (Checked::Valid(Type::Spot), Some(spot)) = (source.type_, &source.spot) {
        let Spot { inner_cone_angle: inner, outer_cone_angle: outer } = *spot;
        if outer > FRAC_PI_2 {
            document.note(
                "light-range",
                &place,
                format!("outerConeAngle {outer} is taken as pi/2, its maximum"),
            );
        }
        if inner > outer {
            let text = format!("innerConeAngle {inner} is above outerConeAngle {outer}, and taken as that");
            document.note("light-range", &place, text);
        } else if inner < 0.0 {
            document.note(
                "light-range",
                &place,
                format!("innerConeAngle {inner} is negative, and taken as 0"),
            );
        }
    }
}

fn light(source: &JsonLight, position: DVec3, direction: Option<DVec3>) -> Option<Light> {
    let intensity = source.color.map(|x| (x * source.intensity).max(0.0));
    if !position.is_finite() || !intensity.iter().all(|x| x.is_finite()) {
        return None;
    }
    let range = source.range.filter(|&range| range > 0.0).unwrap_or(f32::INFINITY);
    match source.type_ {
        Checked::Valid(Type::Point) => Some(Light::Point { position, intensity, range }),
        Checked::Valid(Type::Directional) => {
            Some(Light::Directional { direction: direction?, irradiance: intensity })
        }
        Checked::Valid(Type::Spot) => {
            let Spot { inner_cone_angle, outer_cone_angle } = *source.spot.as_ref()?;
            let outer_cone = outer_cone_angle.clamp(0.0, FRAC_PI_2);
            let inner_cone = inner_cone_angle.clamp(0.0, outer_cone);
            (outer_cone > 0.0).then_some(())?;
            Some(Light::Spot { position, direction: direction?, intensity, range, inner_cone, outer_cone })
        }
        Checked::Invalid => None,
    }
}

//! Point, directional and spot lights.

use glam::DVec3;
use rasray_shaders_glsl::constants::scene::{LIGHT_DIRECTIONAL, LIGHT_POINT, LIGHT_SPOT};

use crate::{distribution::cumulative_shares, kinds::punctual_power, layout::Light};

/// Smallest difference of the two cosines of a spot light's cone, which keeps its edge from dividing by 0.
const NARROWEST_FALLOFF: f32 = 0.001;

/// Packs lights with their shares of the total power, and returns that power, W; `disk` is the largest
/// projected area of all triangles, m^2, and `frame_origin` is in metres, world.
pub fn pack_lights(lights: &[rasray_scene::Light], frame_origin: DVec3, disk: f64) -> (f64, Vec<Light>) {
    let powers: Vec<f64> = lights.iter().map(|light| punctual_power(light, disk)).collect();
    let (total, shares) = cumulative_shares(&powers);
    let packed = lights
        .iter()
        .zip(shares)
        .map(|(light, cumulative)| Light { cumulative, ..pack_light(light, frame_origin) });
    (total, packed.collect())
}

/// Packs one light; `frame_origin` is in metres, world.
fn pack_light(light: &rasray_scene::Light, frame_origin: DVec3) -> Light {
    use rasray_scene::Light as Source;
    match *light {
        Source::Point { position, intensity, range } => Light {
            position: relative(position, frame_origin),
            kind: LIGHT_POINT,
            range,
            intensity,
            ..Light::default()
        },
        Source::Directional { direction, irradiance } => Light {
            kind: LIGHT_DIRECTIONAL,
            direction: unit(direction),
            range: f32::INFINITY,
            intensity: irradiance,
            ..Light::default()
        },
        Source::Spot { position, direction, intensity, range, inner_cone, outer_cone } => {
            let cone_scale = 1.0 / (inner_cone.cos() - outer_cone.cos()).max(NARROWEST_FALLOFF);
            Light {
                position: relative(position, frame_origin),
                kind: LIGHT_SPOT,
                direction: unit(direction),
                range,
                intensity,
                cone_scale,
                cone_offset: -outer_cone.cos() * cone_scale,
                ..Light::default()
            }
        }
    }
}

fn relative(position: DVec3, frame_origin: DVec3) -> [f32; 3] {
    (position - frame_origin).as_vec3().to_array()
}

fn unit(direction: DVec3) -> [f32; 3] {
    direction.normalize_or(DVec3::NEG_Y).as_vec3().to_array()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_relative_and_rounded_once() {
        let light = rasray_scene::Light::Point {
            position: DVec3::new(1e7 + 0.125, 2.0, -3.0),
            intensity: [1.0, 2.0, 3.0],
            range: f32::INFINITY,
        };
        let packed = pack_light(&light, DVec3::new(1e7, 0.0, 0.0));
        assert_eq!(packed.position, [0.125, 2.0, -3.0]);
        assert_eq!((packed.kind, packed.intensity), (LIGHT_POINT, [1.0, 2.0, 3.0]));
    }

    #[test]
    fn a_spot_s_falloff_is_one_at_the_inner_and_zero_at_the_outer_cone() {
        let (inner_cone, outer_cone) = (0.3f32, 0.5f32);
        let light = rasray_scene::Light::Spot {
            position: DVec3::ZERO,
            direction: DVec3::new(0.0, 0.0, -2.0),
            intensity: [1.0; 3],
            range: 10.0,
            inner_cone,
            outer_cone,
        };
        let packed = pack_light(&light, DVec3::ZERO);
        assert_eq!(packed.direction, [0.0, 0.0, -1.0]);
        let falloff = |angle: f32| angle.cos() * packed.cone_scale + packed.cone_offset;
        assert!((falloff(inner_cone) - 1.0).abs() < 1e-5 && falloff(outer_cone).abs() < 1e-5);
        // Equal cones give a hard edge, not a division by zero.
        let hard = rasray_scene::Light::Spot {
            position: DVec3::ZERO,
            direction: DVec3::X,
            intensity: [1.0; 3],
            range: 10.0,
            inner_cone: 0.5,
            outer_cone: 0.5,
        };
        assert!(pack_light(&hard, DVec3::ZERO).cone_scale.is_finite());
    }
}

//! Views and sizes: plain arithmetic, no device.

use rasray_ads::AdsError;
use rasray_shaders_glsl::constants::scene::{LIGHT_DIRECTIONAL, LIGHT_SPOT};
use rasray_shaders_glsl::constants::shadow_maps::{SHADOW_MAPS_CUBE_VIEWS, SHADOW_MAPS_WIDEST_COSINE};
use rasray_shaders_glsl::records::{Light, ShadowMapsHeader, ShadowMapsLight, ShadowMapsView};

use crate::Config;

/// Views of a light: one of a light far away or of a cone of at most 120 degrees, else the six of a cube.
pub fn views_of(light: &Light) -> u32 {
    // As `shadow_maps/build_0_views.comp` has it.
    let is_narrow = || -light.cone_offset >= SHADOW_MAPS_WIDEST_COSINE * light.cone_scale;
    match light.kind {
        LIGHT_DIRECTIONAL => 1,
        LIGHT_SPOT if is_narrow() => 1,
        _ => SHADOW_MAPS_CUBE_VIEWS,
    }
}

/// The views of each light without extent, one after the other, and how many there are.
pub(crate) fn views_of_all(lights: &[Light]) -> (Vec<ShadowMapsLight>, u64) {
    let mut count = 0;
    let views = lights.iter().map(|light| {
        let view_count = views_of(light);
        let first_view = count as u32;
        count += u64::from(view_count);
        ShadowMapsLight { first_view, view_count }
    });
    (views.collect(), count)
}

/// Views of the points on emitting triangles, which follow those of the lights.
pub(crate) fn views_of_emitters(config: &Config, emitters: u32) -> u64 {
    u64::from(SHADOW_MAPS_CUBE_VIEWS) * u64::from(config.points) * u64::from(emitters)
}

/// Texels of that many views.
///
/// # Errors
/// More than 32 bits number.
pub(crate) fn texel_count(config: &Config, views: u64) -> Result<u64, AdsError> {
    let elements = u64::from(config.resolution).pow(2) * views;
    if elements > u64::from(u32::MAX) {
        return Err(AdsError::PoolTooLarge { structure: "shadow-maps", pool: "texels", elements });
    }
    Ok(elements)
}

/// Bytes of the buffers for that many lights and views, in their order: which views lights have, views,
/// texels. At least one element each.
pub(crate) fn sizes(lights: usize, views: u64, texels: u64) -> [u64; 3] {
    [
        size_of::<ShadowMapsHeader>() as u64 + lights.max(1) as u64 * size_of::<ShadowMapsLight>() as u64,
        views.max(1) * size_of::<ShadowMapsView>() as u64,
        texels.max(1) * 4,
    ]
}

/// The page's formula for lights without extent that have these views, and emitting triangles: one of either
/// at least. It shares nothing with what is allocated, so that the two check each other.
pub fn bytes(config: &Config, views: &[u32], emitters: u32) -> u64 {
    let of_lights: u64 = views.iter().copied().map(u64::from).sum();
    let of_emitters = 6 * u64::from(config.points) * u64::from(emitters);
    let all = of_lights + of_emitters;
    32 + 8 * views.len().max(1) as u64 + all * (60 + 4 * u64::from(config.resolution).pow(2))
}

#[cfg(test)]
mod tests {
    use rasray_shaders_glsl::constants::scene::LIGHT_POINT;

    use super::*;

    fn spot(half_angle: f32) -> Light {
        let cone_scale = 7.0;
        Light {
            kind: LIGHT_SPOT,
            cone_scale,
            cone_offset: -half_angle.cos() * cone_scale,
            ..Light::default()
        }
    }

    #[test]
    fn what_is_allocated_is_what_the_page_says() {
        let point = Light { kind: LIGHT_POINT, ..Light::default() };
        let sun = Light { kind: LIGHT_DIRECTIONAL, ..Light::default() };
        let lights = [point, spot(0.2), sun, spot(1.3), point];
        let views: Vec<_> = lights.iter().map(views_of).collect();
        assert_eq!(views, [6, 1, 1, 6, 6]);
        let (table, count) = views_of_all(&lights);
        assert_eq!(table.iter().map(|light| light.first_view).collect::<Vec<_>>(), [0, 6, 7, 8, 14]);
        for (resolution, points) in [(16, 0), (100, 3), (2048, 1), (16, 1024)] {
            let config = Config { points, ..Config::new(resolution) };
            for (lights, views, count) in [(&lights[..], &views[..], count), (&[], &[], 0)] {
                let count = count + views_of_emitters(&config, 2);
                let texels = texel_count(&config, count).expect("they fit");
                let allocated: u64 = sizes(lights.len(), count, texels).iter().sum();
                assert!(count == 0 || allocated == bytes(&config, views, 2), "{config:?}");
            }
        }
        assert!(texel_count(&Config::new(16_384), 16).is_err());
    }
}

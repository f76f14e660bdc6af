//! Views and sizes of shadow maps, by plain arithmetic without a device.

use rasray_ads::AdsError;
use rasray_shaders_glsl::constants::scene::{LIGHT_DIRECTIONAL, LIGHT_SPOT};
use rasray_shaders_glsl::constants::shadow_maps::{SHADOW_MAPS_CUBE_VIEWS, SHADOW_MAPS_WIDEST_COSINE};
use rasray_shaders_glsl::records::{Light, ShadowMapsHeader, ShadowMapsLight, ShadowMapsView};

use crate::Config;

/// Returns the number of views of a light: one for a light far away or a cone of at most 120 degrees,
/// otherwise the six of a cube.
pub fn views_of(light: &Light) -> u32 {
    // The condition is that of `shadow_maps/build_0_views.comp`.
    let is_narrow = || -light.cone_offset >= SHADOW_MAPS_WIDEST_COSINE * light.cone_scale;
    match light.kind {
        LIGHT_DIRECTIONAL => 1,
        LIGHT_SPOT if is_narrow() => 1,
        _ => SHADOW_MAPS_CUBE_VIEWS,
    }
}

/// Returns the views of each light without extent, one light after the other, and the number of all views.
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

/// Returns the number of views of the points on emitting triangles. These views follow those of the lights.
pub(crate) fn views_of_emitters(config: &Config, emitters: u32) -> u64 {
    u64::from(SHADOW_MAPS_CUBE_VIEWS) * u64::from(config.points) * u64::from(emitters)
}

/// Returns the number of texels of `views` views.
///
/// # Errors
/// The number does not fit into 32 bits.
pub(crate) fn texel_count(config: &Config, views: u64) -> Result<u64, AdsError> {
    let elements = u64::from(config.resolution).pow(2) * views;
    let limit = u32::MAX.into();
    if elements > limit {
        return Err(AdsError::PoolTooLarge { structure: "shadow-maps", pool: "texels", elements, limit });
    }
    Ok(elements)
}

/// Returns the bytes of the buffers for this many lights, views and texels, in the order of the buffers:
/// table of the lights' views, views, texels. Each buffer has at least one element.
pub(crate) fn sizes(lights: usize, views: u64, texels: u64) -> [u64; 3] {
    [
        size_of::<ShadowMapsHeader>() as u64 + lights.max(1) as u64 * size_of::<ShadowMapsLight>() as u64,
        views.max(1) * size_of::<ShadowMapsView>() as u64,
        texels.max(1) * 4,
    ]
}

/// Computes the bytes by the formula of `docs/shadow-maps.md`, for lights without extent that have these
/// numbers of views and for emitting triangles; at least one of either. The formula shares no code with the
/// allocation, so that the two check each other.
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

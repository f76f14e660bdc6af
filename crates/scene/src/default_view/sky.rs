//! Sky over scenes that have no light.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::Environment;

/// Width of the map in texels: fine enough that neighbours differ by less than a step of an 8-bit image, but
/// for the rim of the key light.
const WIDTH: u32 = 256;
const HEIGHT: u32 = 128;
/// Radiance straight down, at the horizon and straight up, W/(sr m^2).
const NADIR: f64 = 0.11;
const HORIZON: f64 = 0.2;
const ZENITH: f64 = 0.3;
/// Direction towards the middle of the key light, not normalised: 50 degrees up, 25 degrees to the left of -z
/// turned round, so that the light stands behind the left shoulder of the default camera.
const KEY: DVec3 = DVec3::new(-0.42, 1.19, 0.91);
/// Radiance in the middle of the key light, on top of the sky's.
const KEY_RADIANCE: f64 = 5.0;
/// Angles from the middle of the key light within which it is full and beyond which it is gone, degrees.
const KEY_FULL: f64 = 12.0;
const KEY_END: f64 = 30.0;

/// Makes the map.
pub(super) fn sky() -> Environment {
    let texel = |index: u32| {
        let (column, row) = (index % WIDTH, index / WIDTH);
        let (azimuth, polar) = (
            TAU * (f64::from(column) + 0.5) / f64::from(WIDTH),
            PI * (f64::from(row) + 0.5) / f64::from(HEIGHT),
        );
        let level = polar.sin();
        let direction = DVec3::new(level * azimuth.cos(), polar.cos(), level * azimuth.sin());
        [radiance(direction) as f32; 3]
    };
    Environment::LatLong { width: WIDTH, height: HEIGHT, radiance: (0..WIDTH * HEIGHT).map(texel).collect() }
}

/// Returns the radiance from a unit direction, the same in all channels, W/(sr m^2).
fn radiance(direction: DVec3) -> f64 {
    let end = if direction.y < 0.0 { NADIR } else { ZENITH };
    let sky = HORIZON + (end - HORIZON) * smooth(direction.y.abs());
    let angle = direction.dot(KEY.normalize()).clamp(-1.0, 1.0).acos().to_degrees();
    sky + KEY_RADIANCE * smooth((KEY_END - angle) / (KEY_END - KEY_FULL))
}

/// Returns a smooth step from 0 to 1, level at both ends.
fn smooth(share: f64) -> f64 {
    let share = share.clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

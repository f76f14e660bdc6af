//! Tests whether a scene is lit, and the light of a scene that is not.

use super::emission::mean_emission;
use super::emitters::{emits, shines, shown_materials};
use super::sky::sky;
use crate::{Environment, Light, Motion, Scene, Warning};

/// Least emission that lights a scene: the mean radiance over all of its surfaces, W/(sr m^2). The lamp of a
/// Cornell box gives the box 0.09; a white surface that saw 0.05 all around would be shown as a dark grey.
const LEAST_EMISSION: f64 = 0.05;

/// True if the scene is lit: by a punctual light that is not black, an environment that is not black, or
/// surfaces that emit a mean radiance of at least 0.05 W/(sr m^2). That mean is over the area of all placed
/// triangles, with emission by luminance, as textures shape it, once for each side that emits; surfaces of
/// unlit materials emit their base colour on both sides.
///
/// So lamps light a room, while glowing eyes, screens and marks on an object do not: the object needs another
/// light.
pub fn is_lit(scene: &Scene) -> bool {
    is_lit_always(scene) || mean_emission(scene) >= LEAST_EMISSION
}

/// True if [`is_lit`] depends on the time at which the scene is shown: only surfaces can light the scene, and
/// the share of the emissive ones among all surfaces changes with the motion.
pub fn is_lit_at_times(scene: &Scene) -> bool {
    scene.motion() != Motion::Still && scene.materials.iter().any(emits) && !is_lit_always(scene)
}

/// True if a light or an environment lights the scene, whatever its surfaces emit.
fn is_lit_always(scene: &Scene) -> bool {
    let environment = match &scene.environment {
        Environment::Constant(radiance) => shines(radiance),
        Environment::LatLong { radiance, .. } => radiance.iter().any(|texel| shines(texel)),
    };
    environment || scene.lights.iter().any(light_shines)
}

/// Makes the light of a scene that has none, as a map of 256 x 128 texels: a neutral sky, grey at the
/// horizon, with a broad soft key light half way up, to the left of a camera that looks along -z. A surface
/// of base colour 0.8 that faces the key light has a radiance of about 0.7 W/(sr m^2).
pub fn default_light() -> Environment {
    sky()
}

/// Gives a scene that is not lit (see [`is_lit`]) the [`default_light`], with a warning `default-light` that
/// says why. Returns true if the scene got it.
pub fn ensure_lit(scene: &mut Scene) -> bool {
    if is_lit(scene) {
        return false;
    }
    add_default_light(scene);
    true
}

/// Gives a scene the [`default_light`], with a warning `default-light` that says why.
pub fn add_default_light(scene: &mut Scene) {
    let reason = if shown_materials(scene).any(emits) {
        "what glows in the scene is too little to light it"
    } else {
        "nothing in the scene emits light"
    };
    scene.environment = default_light();
    let message = format!("{reason}; a neutral sky with a soft key light was added");
    scene.warnings.push(Warning { kind: "default-light", message });
}

fn light_shines(light: &Light) -> bool {
    match light {
        Light::Point { intensity, .. } | Light::Spot { intensity, .. } => shines(intensity),
        Light::Directional { irradiance, .. } => shines(irradiance),
    }
}

//! Whether a scene is lit, and the light it gets if it is not.

use crate::{Environment, Material, Scene, Warning};

/// Whether anything lights the scene: a light, an environment that is not black, or a material that
/// emits everywhere (unlit ones do) and is used by a placed mesh with triangles.
///
/// Emission that an emission texture shapes does not count. Such textures draw lamps, screens and
/// glowing marks on objects that are meant to stand in somebody else's light.
pub fn is_lit(scene: &Scene) -> bool {
    let environment = match &scene.environment {
        Environment::Constant(radiance) => radiance.iter().any(|channel| *channel > 0.0),
        Environment::LatLong { radiance, .. } => radiance.iter().flatten().any(|channel| *channel > 0.0),
    };
    environment || !scene.lights.is_empty() || shown_materials(scene).any(lights_scene)
}

/// Whether surfaces of this material send out light by themselves.
pub fn emits(material: &Material) -> bool {
    let shown = |color: &[f32]| color.iter().any(|channel| *channel > 0.0);
    shown(&material.emission) || (material.unlit && shown(&material.base_color[..3]))
}

/// The light of a scene that brings none: white from everywhere, radiance 1 W/(sr m^2).
pub fn default_light() -> Environment {
    Environment::Constant([1.0; 3])
}

/// Gives a scene that nothing lights (see [`is_lit`]) the [`default_light`], with a warning
/// `default-light` that says why. Returns whether it did.
pub fn ensure_lit(scene: &mut Scene) -> bool {
    if is_lit(scene) {
        return false;
    }
    let reason = if shown_materials(scene).any(emits) {
        "nothing lights the scene: what glows does so through emission textures, which count as decoration"
    } else {
        "nothing in the scene emits light"
    };
    scene.environment = default_light();
    let message = format!("{reason}; a white environment of radiance 1 was added");
    scene.warnings.push(Warning { kind: "default-light", message });
    true
}

fn lights_scene(material: &Material) -> bool {
    emits(material) && (material.unlit || material.emission_texture.is_none())
}

/// Materials of placed meshes that have triangles; one for every instance.
fn shown_materials(scene: &Scene) -> impl Iterator<Item = &Material> {
    scene.instances.iter().filter_map(|instance| {
        let mesh = scene.meshes.get(instance.mesh)?;
        let material = scene.materials.get(mesh.material)?;
        (!mesh.indices.is_empty()).then_some(material)
    })
}

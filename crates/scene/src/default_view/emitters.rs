//! Materials that emit light.

use crate::{Material, Scene};

/// True if surfaces of this material emit light.
pub fn emits(material: &Material) -> bool {
    shines(&material.emission) || (material.unlit && shines(&material.base_color[..3]))
}

/// True if a colour is not black.
pub(super) fn shines(color: &[f32]) -> bool {
    color.iter().any(|channel| *channel > 0.0)
}

/// Iterates over the materials of placed meshes that have triangles; one for every instance.
pub(super) fn shown_materials(scene: &Scene) -> impl Iterator<Item = &Material> {
    scene.instances.iter().filter_map(|instance| {
        let mesh = scene.meshes.get(instance.mesh)?;
        let material = scene.materials.get(mesh.material)?;
        (!mesh.indices.is_empty()).then_some(material)
    })
}

//! About how many bytes of a scene are uploaded in addition to positions and indices.

use super::reads::Reads;
use super::{Needs, Term, Workload};
use crate::{AlphaMode, Environment, Light, Scene};

/// Bytes that are uploaded under `needs`, or all that the scene has.
pub(super) fn uploaded(scene: &Scene, needs: Option<(&Needs, Workload)>) -> u64 {
    let requires = |term| needs.is_none_or(|(needs, _)| needs.requires(term));
    attributes(scene, requires) + texels(scene, needs.map(|(_, workload)| workload)) + lights(scene, requires)
}

fn attributes(scene: &Scene, requires: impl Fn(Term) -> bool) -> u64 {
    let mut total = 0_u64;
    let mut seen = vec![false; scene.meshes.len()];
    for instance in &scene.instances {
        let Some(mesh) = scene.meshes.get(instance.mesh) else { continue };
        let vertices = mesh.positions.len() as u64;
        let bytes = |present: bool, term: Term, size: u64| {
            if present && requires(term) { vertices * size } else { 0 }
        };
        // Posed once an instance, so stored as often.
        total += bytes(mesh.normals.is_some(), Term::Normals, 12);
        total += bytes(mesh.tangents.is_some(), Term::Tangents, 16);
        if !std::mem::replace(&mut seen[instance.mesh], true) {
            total += bytes(mesh.uvs[0].is_some(), Term::Uv0, 8);
            total += bytes(mesh.uvs[1].is_some(), Term::Uv1, 8);
            total += bytes(mesh.colors.is_some(), Term::Colors, 16);
        }
    }
    total
}

fn texels(scene: &Scene, workload: Option<Workload>) -> u64 {
    let mut used = vec![workload.is_none(); scene.images.len()];
    if let Some(workload) = workload {
        for material in super::survey::placed_materials(scene) {
            for texture in Reads::of(material, workload).textures() {
                let image = scene.textures.get(texture.texture).map(|texture| texture.image);
                if let Some(slot) = image.and_then(|image| used.get_mut(image)) {
                    *slot = true;
                }
            }
        }
    }
    let bytes = |image: &crate::Image| u64::from(image.width) * u64::from(image.height) * 16 / 3;
    scene.images.iter().zip(used).filter(|(_, used)| *used).map(|(image, _)| bytes(image)).sum()
}

fn lights(scene: &Scene, requires: impl Fn(Term) -> bool) -> u64 {
    let mut total = 0;
    for light in &scene.lights {
        let term = match light {
            Light::Point { .. } => Term::PointLights,
            Light::Directional { .. } => Term::DirectionalLights,
            Light::Spot { .. } => Term::SpotLights,
        };
        total += if requires(term) { std::mem::size_of::<Light>() as u64 } else { 0 };
    }
    if requires(Term::AreaLights) {
        for instance in &scene.instances {
            let Some(mesh) = scene.meshes.get(instance.mesh) else { continue };
            let emits = scene.materials.get(mesh.material).is_some_and(|material| {
                super::reads::is_lit(&material.emission)
                    && !material.unlit
                    && material.alpha_mode != AlphaMode::Blend
            });
            // A triangle's id and its share of the power.
            total += if emits { mesh.triangle_count() as u64 * 8 } else { 0 };
        }
    }
    if let (Environment::LatLong { radiance, .. }, true) = (&scene.environment, requires(Term::Environment)) {
        // Radiance, and the distribution that directions are drawn from.
        total += radiance.len() as u64 * 16;
    }
    total
}

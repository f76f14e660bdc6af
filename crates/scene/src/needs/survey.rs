//! Terms that a scene has, as far as a workload can observe them.

use super::moving::moving_instances;
use super::reads::{Reads, blends, is_anisotropic, is_lit, reads_base_color};
use super::term::Term;
use super::workload::Workload;
use crate::{AlphaMode, Environment, Light, Material, Mesh, Scene, TextureRef};

/// Iterates over the materials of placed triangles, each once, in the order of the scene.
pub(super) fn placed_materials(scene: &Scene) -> impl Iterator<Item = &Material> {
    let mut used = vec![false; scene.materials.len()];
    for mesh in placed_meshes(scene) {
        if let Some(slot) = used.get_mut(mesh.material) {
            *slot = true;
        }
    }
    scene.materials.iter().zip(used).filter(|(_, used)| *used).map(|(material, _)| material)
}

/// Iterates over the placed meshes that have triangles, each once.
fn placed_meshes(scene: &Scene) -> impl Iterator<Item = &Mesh> {
    let mut used = vec![false; scene.meshes.len()];
    for instance in &scene.instances {
        if let Some(slot) = used.get_mut(instance.mesh) {
            *slot = true;
        }
    }
    scene
        .meshes
        .iter()
        .zip(used)
        .filter(|(mesh, used)| *used && !mesh.indices.is_empty())
        .map(|(mesh, _)| mesh)
}

/// Number of finds, and the name of the first.
#[derive(Clone, Debug, Default)]
pub(super) struct Found {
    pub count: usize,
    first: String,
}

impl Found {
    fn add(&mut self, name: &str) {
        if self.count == 0 {
            name.clone_into(&mut self.first);
        }
        self.count += 1;
    }

    /// Says why a term that the workload observes is needed or not.
    pub fn sentence(&self, term: Term) -> String {
        let ((one, many), is, predicate) = words(term);
        let are = if is == "is" { "are" } else { "have" };
        match self.count {
            0 => format!("no {one} {is} {predicate}"),
            1 if self.first.is_empty() => format!("one {one} {is} {predicate}"),
            1 => format!("{one} `{}` {is} {predicate}", self.first),
            count if self.first.is_empty() => format!("{count} {many} {are} {predicate}"),
            count => format!("{count} {many} {are} {predicate}, the first is `{}`", self.first),
        }
    }
}

/// Returns the words of a sentence on a term: subject in singular and plural, `is` or `has`, predicate.
fn words(term: Term) -> ((&'static str, &'static str), &'static str, &'static str) {
    let (mesh, material) = (("mesh", "meshes"), ("material", "materials"));
    match term {
        Term::Normals => (mesh, "has", "shading normals"),
        Term::Tangents => (mesh, "has", "tangents that a normal map or rougher facets are laid along"),
        Term::Uv0 => (mesh, "has", "texture coordinates 0 that a texture is read at"),
        Term::Uv1 => (mesh, "has", "texture coordinates 1 that a texture is read at"),
        Term::Colors => (mesh, "has", "vertex colours that show"),
        Term::BaseColorTextures => (material, "has", "a base colour texture that shows"),
        Term::MetallicRoughnessTextures => (material, "has", "a metallic-roughness texture"),
        Term::AnisotropyTextures => (material, "has", "an anisotropy texture"),
        Term::NormalTextures => (material, "has", "a normal map"),
        Term::EmissionTextures => (material, "has", "an emission texture"),
        Term::TransmissionTextures => (material, "has", "a transmission texture"),
        Term::Emission => (material, "has", "emission"),
        Term::Specular => (material, "has", "specular reflection"),
        Term::Transmission => (material, "has", "transmission"),
        Term::Volume => (material, "has", "absorption inside"),
        Term::AlphaMask => (material, "has", "an alpha mask"),
        Term::AlphaBlend => (material, "has", "partial opacity"),
        Term::PointLights => (("point light", "point lights"), "is", "in the scene"),
        Term::DirectionalLights => (("directional light", "directional lights"), "is", "in the scene"),
        Term::SpotLights => (("spot light", "spot lights"), "is", "in the scene"),
        Term::AreaLights => (mesh, "has", "triangles that emit"),
        Term::Environment => (("environment", "environments"), "has", "radiance"),
        Term::Motion => (("instance", "instances"), "is", "moved or deformed with time"),
    }
}

/// Says why a workload cannot observe a term in any scene; `None` if it can.
pub(super) fn unseen(term: Term, workload: Workload) -> Option<&'static str> {
    let seen = match term {
        Term::Motion | Term::AlphaMask | Term::Uv0 | Term::Uv1 | Term::Colors => true,
        Term::Emission | Term::EmissionTextures | Term::Environment => workload.emission,
        // Unlit materials show their base colour as emission.
        Term::BaseColorTextures => workload.emission || workload.shades || workload.blends,
        Term::AlphaBlend => workload.blends,
        Term::Normals | Term::Tangents | Term::NormalTextures => workload.shades,
        Term::MetallicRoughnessTextures
        | Term::AnisotropyTextures
        | Term::TransmissionTextures
        | Term::Specular
        | Term::Transmission
        | Term::Volume
        | Term::PointLights
        | Term::DirectionalLights
        | Term::SpotLights
        | Term::AreaLights => workload.scatters,
    };
    (!seen).then_some(workload.why)
}

/// Numbers of elements of a scene that have each term.
pub(super) struct Survey {
    counts: [Found; Term::ALL.len()],
}

impl Survey {
    pub fn of(scene: &Scene, workload: Workload) -> Self {
        let mut survey = Self { counts: std::array::from_fn(|_| Found::default()) };
        for material in placed_materials(scene) {
            survey.material(material, workload);
        }
        for mesh in placed_meshes(scene) {
            if let Some(material) = scene.materials.get(mesh.material) {
                survey.mesh(mesh, material, workload);
            }
        }
        for light in &scene.lights {
            survey.add(
                match light {
                    Light::Point { .. } => Term::PointLights,
                    Light::Directional { .. } => Term::DirectionalLights,
                    Light::Spot { .. } => Term::SpotLights,
                },
                "",
            );
        }
        let radiates = match &scene.environment {
            Environment::Constant(radiance) => is_lit(radiance),
            Environment::LatLong { radiance, .. } => radiance.iter().any(|texel| is_lit(texel)),
        };
        survey.add_if(radiates, Term::Environment, "");
        for (instance, moves) in scene.instances.iter().zip(moving_instances(scene)) {
            survey.add_if(moves, Term::Motion, &instance.name);
        }
        survey
    }

    pub fn found(&self, term: Term) -> &Found {
        &self.counts[term as usize]
    }

    fn add(&mut self, term: Term, name: &str) {
        self.counts[term as usize].add(name);
    }

    fn add_if(&mut self, condition: bool, term: Term, name: &str) {
        if condition {
            self.add(term, name);
        }
    }

    fn material(&mut self, material: &Material, workload: Workload) {
        let name = &material.name;
        let reads = Reads::of(material, workload);
        for (texture, term) in [
            (reads.base_color, Term::BaseColorTextures),
            (reads.metallic_roughness, Term::MetallicRoughnessTextures),
            (reads.anisotropy, Term::AnisotropyTextures),
            (reads.normal, Term::NormalTextures),
            (reads.emission, Term::EmissionTextures),
            (reads.transmission, Term::TransmissionTextures),
        ] {
            self.add_if(texture.is_some(), term, name);
        }
        self.add_if(crate::default_view::emits(material), Term::Emission, name);
        self.add_if(matches!(material.alpha_mode, AlphaMode::Mask { .. }), Term::AlphaMask, name);
        self.add_if(blends(material, workload), Term::AlphaBlend, name);
        if material.unlit {
            return;
        }
        // A metallic texture may only lower the factor, so the factors alone decide.
        let dielectric = material.specular > 0.0 && is_lit(&material.specular_color) && material.ior != 1.0;
        self.add_if(dielectric || material.metallic > 0.0, Term::Specular, name);
        let transmits = material.transmission > 0.0;
        self.add_if(transmits, Term::Transmission, name);
        let absorbs = material.attenuation_distance.is_finite() && material.attenuation_color != [1.0; 3];
        self.add_if(transmits && material.thickness > 0.0 && absorbs, Term::Volume, name);
    }

    fn mesh(&mut self, mesh: &Mesh, material: &Material, workload: Workload) {
        let name = &mesh.name;
        let reads = Reads::of(material, workload);
        let shaded = workload.shades && !material.unlit;
        self.add_if(mesh.normals.is_some() && shaded, Term::Normals, name);
        let is_anisotropic = is_anisotropic(material, workload);
        let reads_tangents = reads.normal.is_some() || is_anisotropic;
        self.add_if(mesh.tangents.is_some() && reads_tangents, Term::Tangents, name);
        for (set, term) in [Term::Uv0, Term::Uv1].into_iter().enumerate() {
            let reads_set = |texture: &TextureRef| texture.uv_set as usize == set;
            // Tangents are derived from the first set unless a texture names another.
            let reads_it = reads.textures().any(reads_set) || (is_anisotropic && set == 0);
            self.add_if(mesh.uvs[set].is_some() && reads_it, term, name);
        }
        // Alpha of vertices takes part in masks.
        let colored =
            reads_base_color(material, workload) || matches!(material.alpha_mode, AlphaMode::Mask { .. });
        self.add_if(mesh.colors.is_some() && colored, Term::Colors, name);
        self.add_if(is_lit(&material.emission) && !material.unlit, Term::AreaLights, name);
    }
}

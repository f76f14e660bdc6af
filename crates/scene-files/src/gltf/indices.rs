//! Check that every index is in range, before any look-up.

use std::path::Path;

use ::gltf::json::material::Material;
use ::gltf::json::texture::Info;
use ::gltf::json::{Index, Root};

use super::anisotropy::anisotropy;
use rasray_scene::SceneError;

/// Checks all references of a file.
pub(super) fn check(path: &Path, root: &Root) -> Result<(), SceneError> {
    let check = Check { path };
    check.buffers(root)?;
    check.meshes(root)?;
    check.graph(root)?;
    check.animation(root)?;
    for (i, material) in root.materials.iter().enumerate() {
        check.material(&format!("materials[{i}]"), material, root.textures.len())?;
    }
    check.textures(root)
}

struct Check<'a> {
    path: &'a Path,
}

impl Check<'_> {
    /// Refuses an index that is not below `count`.
    fn index<T>(&self, place: &str, member: &str, index: Index<T>, count: usize) -> Result<(), SceneError> {
        if index.value() < count {
            return Ok(());
        }
        let reason = format!("refers to element {}, but there are only {count}", index.value());
        Err(SceneError::invalid(self.path, format!("{place}.{member}"), reason))
    }

    fn optional<T>(
        &self,
        place: &str,
        member: &str,
        index: Option<Index<T>>,
        count: usize,
    ) -> Result<(), SceneError> {
        index.map_or(Ok(()), |index| self.index(place, member, index, count))
    }

    fn buffers(&self, root: &Root) -> Result<(), SceneError> {
        let views = root.buffer_views.len();
        for (i, view) in root.buffer_views.iter().enumerate() {
            self.index(&format!("bufferViews[{i}]"), "buffer", view.buffer, root.buffers.len())?;
        }
        for (i, accessor) in root.accessors.iter().enumerate() {
            let place = format!("accessors[{i}]");
            self.optional(&place, "bufferView", accessor.buffer_view, views)?;
            if let Some(sparse) = &accessor.sparse {
                self.index(&place, "sparse.indices.bufferView", sparse.indices.buffer_view, views)?;
                self.index(&place, "sparse.values.bufferView", sparse.values.buffer_view, views)?;
            }
        }
        Ok(())
    }

    fn meshes(&self, root: &Root) -> Result<(), SceneError> {
        let accessors = root.accessors.len();
        for (i, mesh) in root.meshes.iter().enumerate() {
            for (k, primitive) in mesh.primitives.iter().enumerate() {
                let place = format!("meshes[{i}].primitives[{k}]");
                self.optional(&place, "indices", primitive.indices, accessors)?;
                self.optional(&place, "material", primitive.material, root.materials.len())?;
                for &attribute in primitive.attributes.values() {
                    self.index(&place, "attributes", attribute, accessors)?;
                }
                for target in primitive.targets.iter().flatten() {
                    for attribute in [target.positions, target.normals, target.tangents] {
                        self.optional(&place, "targets", attribute, accessors)?;
                    }
                }
            }
        }
        Ok(())
    }

    fn graph(&self, root: &Root) -> Result<(), SceneError> {
        let nodes = root.nodes.len();
        self.optional("file", "scene", root.scene, root.scenes.len())?;
        for (i, scene) in root.scenes.iter().enumerate() {
            for &node in &scene.nodes {
                self.index(&format!("scenes[{i}]"), "nodes", node, nodes)?;
            }
        }
        let lights = super::punctual::lights(root);
        for (i, node) in root.nodes.iter().enumerate() {
            let place = format!("nodes[{i}]");
            for &child in node.children.iter().flatten() {
                self.index(&place, "children", child, nodes)?;
            }
            self.optional(&place, "mesh", node.mesh, root.meshes.len())?;
            self.optional(&place, "camera", node.camera, root.cameras.len())?;
            self.optional(&place, "skin", node.skin, root.skins.len())?;
            let light = node.extensions.as_ref().and_then(|found| found.khr_lights_punctual.as_ref());
            self.optional(&place, "light", light.map(|light| light.light), lights.len())?;
        }
        Ok(())
    }

    fn animation(&self, root: &Root) -> Result<(), SceneError> {
        let (nodes, accessors) = (root.nodes.len(), root.accessors.len());
        for (i, skin) in root.skins.iter().enumerate() {
            let place = format!("skins[{i}]");
            self.optional(&place, "inverseBindMatrices", skin.inverse_bind_matrices, accessors)?;
            self.optional(&place, "skeleton", skin.skeleton, nodes)?;
            for &joint in &skin.joints {
                self.index(&place, "joints", joint, nodes)?;
            }
        }
        for (i, animation) in root.animations.iter().enumerate() {
            let place = format!("animations[{i}]");
            for sampler in &animation.samplers {
                self.index(&place, "samplers.input", sampler.input, accessors)?;
                self.index(&place, "samplers.output", sampler.output, accessors)?;
            }
            for channel in &animation.channels {
                self.index(&place, "channels.sampler", channel.sampler, animation.samplers.len())?;
                self.index(&place, "channels.target.node", channel.target.node, nodes)?;
            }
        }
        Ok(())
    }

    fn material(&self, place: &str, material: &Material, textures: usize) -> Result<(), SceneError> {
        let base = &material.pbr_metallic_roughness;
        let mut infos: Vec<(&str, Option<&Info>)> = vec![
            ("baseColorTexture", base.base_color_texture.as_ref()),
            ("metallicRoughnessTexture", base.metallic_roughness_texture.as_ref()),
            ("emissiveTexture", material.emissive_texture.as_ref()),
        ];
        if let Some(extensions) = &material.extensions {
            let transmission = extensions.transmission.as_ref();
            let volume = extensions.volume.as_ref();
            let specular = extensions.specular.as_ref();
            infos.extend([
                ("transmissionTexture", transmission.and_then(|found| found.transmission_texture.as_ref())),
                ("thicknessTexture", volume.and_then(|found| found.thickness_texture.as_ref())),
                ("specularTexture", specular.and_then(|found| found.specular_texture.as_ref())),
                ("specularColorTexture", specular.and_then(|found| found.specular_color_texture.as_ref())),
            ]);
        }
        for (member, info) in infos {
            self.optional(place, member, info.map(|info| info.index), textures)?;
        }
        // Extensions that cannot be read are refused elsewhere.
        let anisotropy = anisotropy(material).ok().flatten();
        let info = anisotropy.and_then(|found| found.texture);
        self.optional(place, "anisotropyTexture", info.map(|info| info.index), textures)?;
        self.optional(
            place,
            "normalTexture",
            material.normal_texture.as_ref().map(|info| info.index),
            textures,
        )?;
        self.optional(
            place,
            "occlusionTexture",
            material.occlusion_texture.as_ref().map(|info| info.index),
            textures,
        )
    }

    fn textures(&self, root: &Root) -> Result<(), SceneError> {
        for (i, texture) in root.textures.iter().enumerate() {
            let place = format!("textures[{i}]");
            self.optional(&place, "sampler", texture.sampler, root.samplers.len())?;
            // The image is checked where a material uses the texture: files with unused textures
            // that refer to nothing are common and harmless.
        }
        for (i, image) in root.images.iter().enumerate() {
            self.optional(&format!("images[{i}]"), "bufferView", image.buffer_view, root.buffer_views.len())?;
        }
        Ok(())
    }
}

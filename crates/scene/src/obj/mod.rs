//! Wavefront OBJ with MTL materials.
//!
//! Read are `v`, `vt`, `vn`, `f` (all index forms, negative indices too), `o`, `g`, `usemtl` and
//! `mtllib`. Polygons become fans from their first corner, which is right for convex ones. Triangles
//! keep the order of the file; a new mesh begins where the material changes, or where faces begin or
//! cease to have texture coordinates or normals. Each mesh is placed once, where the file has it.
//! Smoothing groups, lines, points and free-form surfaces are not read.
//!
//! The v coordinate is turned over: OBJ counts from the bottom of the image, [`crate::Image`] from
//! the top. Bytes that are not UTF-8 are tolerated in names.
//!
//! Materials become metallic-roughness ones. Colours are taken as linear and limited to [0, 1], emission to at least 0.
//!
//! | MTL | here |
//! |---|---|
//! | `Kd` (0.8) | base colour; black counts as white where a `map_Kd` is given |
//! | `Ks` (black) | dielectric specular: strength is the largest channel, colour the ratio to it |
//! | `Ns` (0) | perceptual roughness (2 / (Ns + 2))^(1/4): the Phong lobe whose width is that of a microfacet distribution with alpha^2 = 2 / (Ns + 2) |
//! | `Ke`, `map_Ke` | emission; a map without `Ke` has factor 1 |
//! | `d`, `Tr` | opacity below 1 blends |
//! | `map_d` | alpha mask at one half, together with `map_Kd` in one image |
//! | `Ni` | index of refraction, 1.5 unless it is in [1, 10] |
//! | `illum` 4, 6, 7, 9 | transmits, coloured by `Tf` (white); 6 and 7 refract, the others are thin walls |
//! | `illum` 3, 5, 8 with black `Kd` and a `Ks` | a mirror: metal of colour `Ks` |
//! | `norm` | normal map |

mod geometry;
mod material;
mod mtl;
mod reference;
mod statements;
mod textures;

use std::collections::HashMap;
use std::path::Path;

use glam::DAffine3;

use crate::default_view::plain_material;
use crate::load::{read_file, scene_name};
use crate::{Instance, LoadOptions, Material, Mesh, Scene, SceneError, Warning};
use geometry::{Geometry, Library};
use mtl::MtlMaterial;
use textures::Textures;

/// Loads an OBJ file, the material libraries it names, and the textures that these name.
///
/// A library, material or texture that is missing is a warning; the triangles are shown in light
/// grey, or without the texture.
///
/// # Errors
/// - [`SceneError::Read`] if the file cannot be read; [`SceneError::TooLarge`] beyond a limit.
/// - [`SceneError::Syntax`] for a word where a number must be, with the line.
/// - [`SceneError::IndexOutOfRange`] or [`SceneError::Invalid`] for a face that refers to what is not
///   defined above it, with the line.
/// - [`SceneError::UnsafeReference`] for a library or texture with an absolute path or one with `..`.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    let bytes = read_file(path, options.limits.file_bytes)?;
    let Geometry { mut meshes, material_names, libraries, mut warnings } =
        geometry::read(path, &bytes, &options.limits)?;
    drop(bytes);

    let known = read_libraries(path, &libraries, options, &mut warnings)?;
    let mut textures = Textures::new(path, &options.limits);
    let mut materials = translate(&material_names, &known, &mut textures, &mut warnings)?;
    let (textures, images) = textures.finish();
    if materials.is_empty() {
        materials.push(plain_material("default"));
    }

    let mut found = Vec::new();
    for mesh in &mut meshes {
        crate::check::clean_mesh(path, mesh, &mut found)?;
    }
    warnings.extend(first_of_each_kind(found));
    if meshes.is_empty() {
        warnings.push(Warning {
            kind: "no-triangles",
            message: "the file has no faces; the scene shows only the background".to_owned(),
        });
    }
    Ok(Scene {
        name: scene_name(path),
        instances: place(&meshes),
        meshes,
        materials,
        textures,
        images,
        warnings,
        ..Scene::default()
    })
}

/// All materials of all libraries by name; the first definition of a name counts.
fn read_libraries(
    path: &Path,
    libraries: &[Library],
    options: &LoadOptions,
    warnings: &mut Vec<Warning>,
) -> Result<HashMap<String, MtlMaterial>, SceneError> {
    let mut known = HashMap::new();
    let folder = path.parent().unwrap_or(Path::new(""));
    for library in libraries {
        let mut read = 0;
        for file in library.files(path, folder)? {
            match read_file(&file, options.limits.file_bytes) {
                Ok(bytes) => {
                    read += 1;
                    for material in mtl::parse(&file, &bytes, warnings)? {
                        known.entry(material.name.clone()).or_insert(material);
                    }
                }
                Err(SceneError::Read { source, .. }) => warnings.push(Warning {
                    kind: "missing-material-library",
                    message: format!("{}: {source}; its materials are shown in light grey", file.display()),
                }),
                Err(error) => return Err(error),
            }
        }
        tracing::debug!(library = library.name, files = read, "material library");
    }
    Ok(known)
}

/// The materials that faces use, in the order of their first use.
fn translate(
    names: &[String],
    known: &HashMap<String, MtlMaterial>,
    textures: &mut Textures<'_>,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Material>, SceneError> {
    let mut materials = Vec::with_capacity(names.len());
    let mut missing = Vec::new();
    for name in names {
        materials.push(match known.get(name) {
            Some(found) => material::translate(found, textures, warnings)?,
            None if name.is_empty() => plain_material("default"),
            None => {
                missing.push(name.as_str());
                plain_material(name)
            }
        });
    }
    if let Some(first) = missing.first() {
        let count = missing.len();
        let message = format!(
            "{count} materials are not defined, the first is `{first}`; their triangles are shown in light grey"
        );
        warnings.push(Warning { kind: "missing-material", message });
    }
    Ok(materials)
}

/// One instance a mesh; names that occur more than once get a running number.
fn place(meshes: &[Mesh]) -> Vec<Instance> {
    let mut seen: HashMap<&str, usize> = HashMap::new();
    let mut instances = Vec::with_capacity(meshes.len());
    for (index, mesh) in meshes.iter().enumerate() {
        let count = seen.entry(&mesh.name).or_default();
        *count += 1;
        let name = if *count == 1 { mesh.name.clone() } else { format!("{} {count}", mesh.name) };
        instances.push(Instance { name, mesh: index, world_from_mesh: DAffine3::IDENTITY });
    }
    instances
}

/// Hundreds of meshes may share a fault: the first warning of a kind stands for all, with a count.
pub(crate) fn first_of_each_kind(found: Vec<Warning>) -> Vec<Warning> {
    let mut kept: Vec<(Warning, usize)> = Vec::new();
    for warning in found {
        match kept.iter_mut().find(|(first, _)| first.kind == warning.kind) {
            Some((_, more)) => *more += 1,
            None => kept.push((warning, 0)),
        }
    }
    let told = |(mut warning, more): (Warning, usize)| {
        if more > 0 {
            warning.message = format!("{} (and the like in {more} more meshes)", warning.message);
        }
        warning
    };
    kept.into_iter().map(told).collect()
}

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
mod skipped;
mod statements;
mod textures;

use std::collections::HashMap;
use std::path::Path;

use glam::DAffine3;

use crate::default_view::plain_material;
use crate::files::read_file;
use crate::finish::{Empty, finish, scene_name};
use crate::recognise::{binary, recognise};
use crate::remarks::Remarks;
use crate::text::{reason, shown};
use crate::{Instance, LoadOptions, Material, Mesh, Scene, SceneError};
use geometry::{Geometry, Library};
use mtl::MtlMaterial;
use textures::Textures;

/// Loads an OBJ file, the material libraries it names, and the textures that these name.
///
/// A library, material or texture that is missing is a warning; the triangles are shown in light
/// grey, or without the texture. A file without faces is a scene without triangles, with a warning.
///
/// # Errors
/// - [`SceneError::Read`] if the file cannot be read; [`SceneError::TooLarge`] beyond a limit.
/// - [`SceneError::NotThisFormat`] for binary data and files of other formats.
/// - [`SceneError::Syntax`] for a word where a number must be, with the line, and where no line is a
///   statement of the format.
/// - [`SceneError::IndexOutOfRange`] or [`SceneError::Invalid`] for a face that refers to what is not
///   defined above it, with the line.
/// - [`SceneError::UnsafeReference`] for a library or texture with an absolute path or one with `..`.
/// - [`SceneError::NoTriangles`] if there are faces and none can be shown.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    let bytes = read_file(path, options.limits.file_bytes)?;
    if let Some(foreign) = recognise(&bytes).or_else(|| binary(&bytes)) {
        return Err(foreign.refuse(path, "an OBJ file"));
    }
    let mut remarks = Remarks::default();
    let Geometry { mut meshes, material_names, libraries, skipped, vertices } =
        geometry::read(path, &bytes, &options.limits)?;
    drop(bytes);
    skipped.report(&mut remarks);

    let known = read_libraries(path, &libraries, options, &mut remarks)?;
    let mut textures = Textures::new(path, &options.limits);
    let mut materials = translate(&material_names, &known, &mut textures, &mut remarks)?;
    let (textures, images) = textures.finish();
    if materials.is_empty() {
        materials.push(plain_material("default"));
    }
    for mesh in &mut meshes {
        crate::check::clean(path, mesh, &mut remarks)?;
    }
    let has_faces = !meshes.is_empty() || skipped.faces > 0;
    let scene = Scene {
        name: scene_name(path),
        instances: place(&meshes),
        meshes,
        materials,
        textures,
        images,
        ..Scene::default()
    };
    finish(path, scene, remarks, |remarks| {
        Some(if has_faces {
            Empty::Dropped(remarks.sentence(&["short-faces", "dropped-triangles"]))
        } else {
            Empty::Bare(format!("the file has {vertices} vertices and no faces"))
        })
    })
}

/// All materials of all libraries by name; the first definition of a name counts.
fn read_libraries(
    path: &Path,
    libraries: &[Library],
    options: &LoadOptions,
    remarks: &mut Remarks,
) -> Result<HashMap<String, MtlMaterial>, SceneError> {
    let mut known = HashMap::new();
    let folder = path.parent().unwrap_or(Path::new(""));
    for library in libraries {
        let mut read = 0;
        for file in library.files(path, folder)? {
            let mut missing = |why: String| {
                let text = format!("{why}; its materials are shown in light grey");
                remarks.note("missing-material-library", file.display().to_string(), text);
            };
            match read_file(&file, options.limits.file_bytes) {
                Ok(bytes) => match recognise(&bytes).filter(|_| !bytes.is_empty()).or_else(|| binary(&bytes))
                {
                    Some(foreign) => missing(format!("is {}, not a material library", foreign.what)),
                    None => {
                        read += 1;
                        remarks.files.push(file.clone());
                        let materials = mtl::parse(&file, &bytes, remarks);
                        for material in materials.map_err(|error| error.of_scene(path))? {
                            known.entry(material.name.clone()).or_insert(material);
                        }
                    }
                },
                Err(SceneError::Read { source, .. }) => missing(reason(&source)),
                Err(error) => return Err(error.of_scene(path)),
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
    remarks: &mut Remarks,
) -> Result<Vec<Material>, SceneError> {
    let mut materials = Vec::with_capacity(names.len());
    let mut missing = Vec::new();
    for name in names {
        materials.push(match known.get(name) {
            Some(found) => material::translate(found, textures, remarks)?,
            None if name.is_empty() => plain_material("default"),
            None => {
                missing.push(name.as_str());
                plain_material(name)
            }
        });
    }
    if let Some(first) = missing.first() {
        let first = shown(first);
        let text = format!(
            "materials are not defined, the first is `{first}`; their triangles are shown in light grey"
        );
        remarks.count("missing-material", "", missing.len(), text);
    }
    Ok(materials)
}

/// One instance per mesh; names that occur more than once get a running number.
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

//! Reader of Wavefront OBJ with MTL materials.
//!
//! The reader takes `v`, `vt`, `vn`, `f` (all index forms, negative indices too), `o`, `g`, `s`, `usemtl` and
//! `mtllib`. A polygon becomes a fan from its first corner where the fan fills it, as for every convex
//! polygon; others are cut along their ears, into as many triangles. Triangles keep the order of the file; a
//! new mesh begins where the material changes, or where faces begin or cease to have texture coordinates or
//! normals. Each mesh is placed once, at its place in the file: coordinates are read in double precision, and
//! those of a file far from the origin are kept relative to an origin that the instance carries, so that
//! single precision suffices; a mesh whose groups (`g`, `o`) lie too far apart for one origin is divided.
//! Files whose coordinates are single-precision numbers keep every bit.
//!
//! Faces without normals are flat, unless they are in a smoothing group: then the normal of a vertex is the
//! sum of the normals of the group's faces there, weighted by area. Lines, points, colours of vertices and
//! free-form surfaces are not read, and are named in a warning.
//!
//! The v coordinate is flipped: OBJ counts from the bottom of the image, [`rasray_scene::Image`] from the
//! top. Bytes that are not UTF-8 are tolerated in names.
//!
//! Materials become metallic-roughness ones. Colours are taken as linear and limited to [0, 1], emission to
//! at least 0.
//!
//! | MTL | here |
//! |---|---|
//! | `Kd` (0.8) | base colour; black counts as white where a `map_Kd` is given |
//! | `Ks` (black) | dielectric specular: strength is the largest channel, colour the ratio to it |
//! | `Ns` (0) | perceptual roughness (2 / (Ns + 2))^(1/4): the Phong lobe whose width is that of a microfacet distribution with alpha^2 = 2 / (Ns + 2) |
//! | `Ke`, `map_Ke` | emission; a map without `Ke` has factor 1 |
//! | `d`, `Tr` | opacity below 1 blends |
//! | `map_d` | alpha mask at one half, together with `map_Kd` in one image |
//! | `Ni` | index of refraction, 1.5 unless it is in [1, 10]; 1 counts as 1.5 where there is a `Ks` and no glass, since nothing would reflect |
//! | `illum` 4, 6, 7, 9 | glass, unless the rule below says otherwise: transmits, coloured by `Tf` (white); 6 and 7 refract, the others are thin walls |
//! | `illum` 3, 5, 8 with black `Kd` and a `Ks` | a mirror: metal of colour `Ks` |
//! | `Pr`, `Pm` | perceptual roughness and metallic, in place of what follows from the others |
//! | `norm` | normal map; `-bm` is its strength |
//!
//! **Glass or not.** The four `illum` numbers of transparency say that light passes, but exporters write them
//! for surfaces that are only faded or even opaque. Blender writes `illum 9` (6 for metals) wherever `d` is
//! below 1, with `Kd` for the colour and no `Tf`; Maya writes `illum 4`, `Tf 1 1 1` and `Ni 1` for opaque
//! surfaces. So such a material is glass only where
//! - it has no colour of its own: neither a `Kd` that is not black nor a `map_Kd`, or
//! - it has a `Tf`, and no `Ni` of at most 1, which would bend no light, or
//! - it has no `Tf`, an `Ni` above 1, and no `d` between 0 and 1.
//!
//! With a black `Tf` a material never is glass. A material that is no glass is shown by `Kd` and `d`, as with
//! any other `illum`. A glass that also has a `Kd` or a `d` between 0 and 1 gets a warning that they are not
//! shown.

mod apart;
mod geometry;
mod library;
mod material;
mod mtl;
mod skipped;
mod smoothing;
mod statements;
mod textures;

use std::collections::HashMap;
use std::path::Path;

use crate::LoadOptions;
use crate::files::read_file;
use crate::finish::{Empty, finish, scene_name};
use crate::origin::{Origins, place, settle, texture_coordinates};
use crate::recognise::{binary, recognise};
use crate::reference::Place;
use geometry::Geometry;
use library::Library;
use mtl::MtlMaterial;
use rasray_scene::default_view::plain_material;
use rasray_scene::remarks::Remarks;
use rasray_scene::text::{reason, shown};
use rasray_scene::{Material, Scene, SceneError};
use textures::Textures;

/// Loads an OBJ file, the material libraries it names, and the textures that these name.
///
/// A library, material or texture that is missing is a warning; the triangles are shown in light grey, or
/// without the texture. A file that is named by an absolute path or by `..` is never read there; a file of
/// its name beside the file that names it stands in. A file without faces is a scene without triangles, with
/// a warning.
///
/// # Errors
/// - [`SceneError::Read`] if the file cannot be read; [`SceneError::TooLarge`] beyond a limit.
/// - [`SceneError::NotThisFormat`] for binary data and files of other formats.
/// - [`SceneError::Syntax`] for a word where a number must be, with the line, and where no line is a
///   statement of the format.
/// - [`SceneError::IndexOutOfRange`] or [`SceneError::Invalid`] for a face that refers to an element that is
///   not defined above it, with the line.
/// - [`SceneError::NoTriangles`] if there are faces and none can be shown.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    load_placed(path, options, Origins::Own)
}

/// Loads an OBJ file as [`load`] does, with meshes placed by `origins`.
pub(crate) fn load_placed(
    path: &Path,
    options: &LoadOptions,
    origins: Origins<'_>,
) -> Result<Scene, SceneError> {
    let bytes = read_file(path, options.limits.file_bytes)?;
    if let Some(foreign) = recognise(&bytes).or_else(|| binary(&bytes)) {
        return Err(foreign.refuse(path, "an OBJ file"));
    }
    let mut remarks = Remarks::default();
    let Geometry { mut meshes, positions, uvs, material_names, libraries, skipped, vertices } =
        geometry::read(path, &bytes, &options.limits, matches!(origins, Origins::Own))?;
    drop(bytes);
    let origins = settle(&mut meshes, &positions, origins);
    drop(positions);
    skipped.report(&mut remarks);

    let known = read_libraries(path, &libraries, options, &mut remarks)?;
    let mut textures = Textures::new(path, &options.limits);
    let mut materials = translate(&material_names, &known, &mut textures, &mut remarks)?;
    let (textures, images) = textures.finish();
    if materials.is_empty() {
        materials.push(plain_material("default"));
    }
    for (mesh, uvs) in meshes.iter_mut().zip(uvs) {
        let material = &materials[mesh.material];
        mesh.uvs[0] = uvs.map(|uvs| texture_coordinates(&uvs, material, &textures));
        rasray_scene::check::clean(path, mesh, &mut remarks)?;
    }
    let has_faces = !meshes.is_empty() || skipped.faces > 0;
    let scene = Scene {
        name: scene_name(path),
        instances: place(&meshes, &origins),
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

/// Reads all materials of all libraries by name; the first definition of a name counts.
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
        for (name, place) in library.files(folder) {
            let missing = |remarks: &mut Remarks, file: &str, why: String| {
                let text = format!("{why}; its materials are shown in light grey");
                remarks.note("missing-material-library", file, text);
            };
            let file = match place {
                Place::Below(file) => file,
                Place::Outside { reason, beside } => match beside.filter(|file| file.is_file()) {
                    Some(file) => {
                        let text = format!("the reference {reason}; {} is read instead", file.display());
                        remarks.note("library-elsewhere", format!("material library {name}"), text);
                        file
                    }
                    None => {
                        let text =
                            format!("is not read: the reference {reason}; put the file beside the scene");
                        missing(remarks, name, text);
                        continue;
                    }
                },
            };
            let shown_file = file.display().to_string();
            match read_file(&file, options.limits.file_bytes) {
                Ok(bytes) => match recognise(&bytes).filter(|_| !bytes.is_empty()).or_else(|| binary(&bytes))
                {
                    Some(foreign) => {
                        let text = format!("is {}, not a material library", foreign.what);
                        missing(remarks, &shown_file, text);
                    }
                    None => {
                        read += 1;
                        remarks.files.push(file.clone());
                        let materials = mtl::parse(&file, &bytes, remarks);
                        for material in materials.map_err(|error| error.of_scene(path))? {
                            known.entry(material.name.clone()).or_insert(material);
                        }
                    }
                },
                Err(SceneError::Read { source, .. }) => missing(remarks, &shown_file, reason(&source)),
                Err(error) => return Err(error.of_scene(path)),
            }
        }
        tracing::debug!(library = library.name, files = read, "material library");
    }
    Ok(known)
}

/// Translates the materials that faces use, in the order of their first use.
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

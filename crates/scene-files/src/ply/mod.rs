//! Reader of PLY meshes: ASCII, and binary of either byte order.
//!
//! The reader takes `x y z`, `nx ny nz`, texture coordinates (`s t`, `u v`, `texture_u texture_v` or
//! `texture_s texture_t`), and `red green blue alpha` (also `r g b a` and `diffuse_red` and so on) of the
//! element `vertex`. Of the element `face` it takes the list `vertex_indices` or `vertex_index`, and the
//! colour under the same names. Properties may have any scalar type. Where the header names images (`comment
//! TextureFile NAME`), the list `texcoord` and the number `texnumber` of faces are read, too. Polygons become
//! triangles as in OBJ files. The same lists of `tristrips` are triangle strips, which a negative index ends.
//! All other properties and elements are skipped, with a warning that names them.
//!
//! Faces with colours or texture coordinates of their own have vertices of their own: each vertex of the file
//! occurs once for each colour and coordinate that faces give it. Colours and texture coordinates of faces
//! replace those of vertices. Each texture is a mesh with a material of its own, with its triangles in the
//! order of the file.
//!
//! The v coordinate is flipped, as for OBJ. Colours in whole numbers are sRGB and become linear, colours in
//! floating point are taken as linear; alpha is linear either way, and is not shown.
//!
//! Coordinates are read in double precision, and those of a file far from the origin are kept relative to an
//! origin that the instance carries, as for OBJ.

mod body;
mod faces;
mod header;
mod mesh;
mod vertices;

use std::path::Path;

use crate::files::read_file;
use crate::finish::{Empty, finish, scene_name};
use crate::images::{Encoded, count_texels, read_image};
use crate::origin::{Origins, place, settle, texture_coordinates};
use crate::{LoadOptions, reference};
use rasray_scene::default_view::plain_material;
use rasray_scene::remarks::Remarks;
use rasray_scene::{Filter, Material, Mesh, Scene, SceneError, Texture, TextureRef, Wrap};

/// Loads a PLY file as one mesh, or one for each texture, with plain materials, at its place in the file.
///
/// A file without faces (a point cloud) is a scene without triangles, with a warning.
///
/// # Errors
/// [`SceneError::Read`], [`SceneError::TooLarge`], [`SceneError::NotThisFormat`], [`SceneError::Syntax`] for
/// an invalid header or number or a file that ends too early, [`SceneError::IndexOutOfRange`] for a face that
/// refers to a vertex that does not exist, and [`SceneError::NoTriangles`] if there are faces and none can be
/// shown.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    load_placed(path, options, Origins::Own)
}

/// Loads a PLY file as [`load`] does, with meshes placed by `origins`.
pub(crate) fn load_placed(
    path: &Path,
    options: &LoadOptions,
    origins: Origins<'_>,
) -> Result<Scene, SceneError> {
    let bytes = read_file(path, options.limits.file_bytes)?;
    let mut remarks = Remarks::default();
    let header = header::parse(path, &bytes)?;
    let mesh::Content { mut meshes, positions, uvs, texture_of, vertices } =
        mesh::read(path, &bytes, &header, &options.limits, &mut remarks)?;
    drop(bytes);
    let origins = settle(&mut meshes, &positions, origins);
    drop(positions);

    let name = scene_name(path);
    let mut scene = Scene { name: name.clone(), ..Scene::default() };
    let mut pixels = 0;
    for (index, ((mesh, uvs), texture)) in meshes.iter_mut().zip(uvs).zip(&texture_of).enumerate() {
        mesh.name.clone_from(&name);
        mesh.material = index;
        let material = match texture {
            Some(texture) => textured(path, texture, options, &mut scene, &mut pixels, &mut remarks)?,
            None => plain_material("default"),
        };
        mesh.uvs[0] = uvs.map(|uvs| texture_coordinates(&uvs, &material, &scene.textures));
        rasray_scene::check::clean(path, mesh, &mut remarks)?;
        scene.materials.push(of_colors(material, mesh));
    }
    if scene.materials.is_empty() {
        scene.materials.push(plain_material("default"));
    }
    scene.instances = place(&meshes, &origins);
    scene.meshes = meshes;
    finish(path, scene, remarks, |remarks| {
        let dropped = remarks.sentence(&["short-faces", "dropped-triangles"]);
        Some(if dropped.is_empty() {
            Empty::Bare(format!("the file has {vertices} vertices and no faces; points are not rendered"))
        } else {
            Empty::Dropped(dropped)
        })
    })
}

/// Makes the material of a mesh with colours white, so that it does not dim them.
fn of_colors(material: Material, mesh: &Mesh) -> Material {
    if mesh.colors.is_some() { Material { base_color: [1.0; 4], ..material } } else { material }
}

/// Makes a material that shows an image file; if the file cannot be read, the material has no texture and a
/// remark is noted.
fn textured(
    path: &Path,
    name: &str,
    options: &LoadOptions,
    scene: &mut Scene,
    pixels: &mut u64,
    remarks: &mut Remarks,
) -> Result<Material, SceneError> {
    let material = plain_material(name);
    let folder = path.parent().unwrap_or(Path::new(""));
    let Some(file) = reference::texture(&reference::place(folder, name), name, remarks) else {
        return Ok(material);
    };
    let Some(image) = read_image(path, name, Encoded::File(&file), &options.limits, remarks)? else {
        return Ok(material);
    };
    count_texels(path, &image, pixels, &options.limits)?;
    scene.images.push(image);
    scene.textures.push(Texture {
        image: scene.images.len() - 1,
        wrap_u: Wrap::Repeat,
        wrap_v: Wrap::Repeat,
        filter: Filter::Linear,
        mipmapped: true,
    });
    let texture = TextureRef {
        texture: scene.textures.len() - 1,
        uv_set: 0,
        uv_transform: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    };
    Ok(Material { base_color: [1.0; 4], base_color_texture: Some(texture), ..material })
}

//! PLY meshes: ASCII, and binary of either byte order.
//!
//! Of the element `vertex` are read `x y z`, `nx ny nz`, `s t` or `u v` or `texture_u texture_v`, and
//! `red green blue alpha`; of `face` the list `vertex_indices` or `vertex_index`. Any scalar type
//! will do. Polygons become fans from their first corner. The same lists of `tristrips` are triangle
//! strips, which a negative index ends. Everything else is skipped.
//!
//! The v coordinate is turned over, as for OBJ. Colours in whole numbers are sRGB and become linear,
//! colours in floating point are taken as linear; alpha is linear either way.

mod body;
mod header;
mod mesh;

use std::path::Path;

use glam::DAffine3;

use crate::default_view::plain_material;
use crate::files::read_file;
use crate::finish::{Empty, finish, scene_name};
use crate::remarks::Remarks;
use crate::{Instance, LoadOptions, Material, Scene, SceneError};

/// Loads a PLY file as one mesh, with a plain material, placed where the file has it.
///
/// A file without faces (a point cloud) is a scene without triangles, with a warning.
///
/// # Errors
/// [`SceneError::Read`], [`SceneError::TooLarge`], [`SceneError::NotThisFormat`], [`SceneError::Syntax`]
/// for a header or number that is not as it must be or a file that ends too early,
/// [`SceneError::IndexOutOfRange`] for a face that refers to a vertex that does not exist, and
/// [`SceneError::NoTriangles`] if there are faces and none can be shown.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    let bytes = read_file(path, options.limits.file_bytes)?;
    let mut remarks = Remarks::default();
    let header = header::parse(path, &bytes)?;
    let mut mesh = mesh::read(path, &bytes, &header, &options.limits, &mut remarks)?;
    drop(bytes);
    let name = scene_name(path);
    mesh.name.clone_from(&name);
    crate::check::clean(path, &mut mesh, &mut remarks)?;

    let mut material = plain_material("default");
    if mesh.colors.is_some() {
        material = Material { base_color: [1.0; 4], ..material };
    }
    let vertices = mesh.positions.len();
    let mut scene = Scene { name: name.clone(), materials: vec![material], ..Scene::default() };
    if !mesh.indices.is_empty() {
        scene.meshes.push(mesh);
        scene.instances.push(Instance { name, mesh: 0, world_from_mesh: DAffine3::IDENTITY });
    }
    finish(path, scene, remarks, |remarks| {
        let dropped = remarks.sentence(&["short-faces", "dropped-triangles"]);
        Some(if dropped.is_empty() {
            Empty::Bare(format!("the file has {vertices} vertices and no faces; points are not rendered"))
        } else {
            Empty::Dropped(dropped)
        })
    })
}

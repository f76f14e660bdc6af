//! Reader of glTF 2.0 and GLB.
//!
//! The `gltf` crate provides the typed JSON of a file; its wrappers, which index and unwrap freely, are never
//! used. All claims of a file are checked here first: indices, types, byte ranges (in u128), the node graph
//! (iteratively), references to other files.
//!
//! Only parts that the chosen scene needs are read: a buffer, image or accessor to which only another part of
//! the file refers may be missing or broken.
//!
//! Units are taken as written: metres, radians, and for light the number in the file, which is read as
//! radiometric: point and spot intensities as W/sr, directional illuminance as W/m^2, emission as W/(sr m^2).
//! A photometric file is thus scaled by one constant, and exposure compensates for it.
//!
//! Scene order is depth-first over the nodes of the chosen scene, then the primitives of the node's
//! mesh in order, then (with `EXT_mesh_gpu_instancing`) the instances of the node in order.

mod accessor;
mod animations;
mod anisotropy;
mod attributes;
mod buffer_views;
mod buffers;
mod cameras;
#[cfg(feature = "meshopt")]
mod compression;
mod conform;
mod container;
mod deformation;
mod document;
mod draco;
mod elements;
mod extensions;
mod hierarchy;
mod indices;
mod instancing;
mod json;
mod lights;
mod materials;
mod primitives;
mod punctual;
mod shape;
mod skins;
mod textures;
mod transforms;
mod unread;
mod uri;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use crate::LoadOptions;
use crate::decode::panic_message;
use crate::files::read_file;
use crate::finish::{Empty, finish, scene_name};
use rasray_scene::{Animation, Scene, SceneError};

/// Loads a `.gltf` or `.glb` file; its first bytes decide which of the two formats it has. Files that it
/// refers to are read from its folder or below.
///
/// # Errors
/// [`SceneError`]: see [`crate::load`].
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    let bytes = read_file(path, options.limits.file_bytes)?;
    from_slice(path, &bytes, options)
}

/// Loads the bytes of a `.gltf` or `.glb` file as if they had been read from `path`, which need not exist: it
/// names the scene, and references are looked up in its folder.
///
/// # Errors
/// [`SceneError`]: see [`crate::load`].
pub fn from_slice(path: &Path, bytes: &[u8], options: &LoadOptions) -> Result<Scene, SceneError> {
    // Last safety net under the checks: a panic of a library becomes an error.
    catch_unwind(AssertUnwindSafe(|| build(path, bytes, options))).unwrap_or_else(|panic| {
        Err(SceneError::Internal { path: path.to_owned(), reason: panic_message(&*panic) })
    })
}

fn build(path: &Path, bytes: &[u8], options: &LoadOptions) -> Result<Scene, SceneError> {
    let document = document::Document::open(path, bytes, options)?;
    let hierarchy = hierarchy::Hierarchy::of(&document)?;
    let order = hierarchy.scene_order(&document, &options.scene)?;
    let skins = skins::read_all(&document)?;
    let placed = elements::place(&document, &hierarchy, &skins, &order)?;
    let elements::Placed { meshes, instances, placements, deformed } = placed;
    let animation = animations::read(&document, &hierarchy, skins, deformed, placements)?;
    rasray_scene::flattened::remark(&animation.rig, &instances, &[], &mut document.remarks.borrow_mut());
    let mut scene = Scene { name: scene_name(path), meshes, instances, animation, ..Scene::default() };
    let rig = &scene.animation.rig;
    if rig.clips.is_empty() && rig.deformed.is_empty() {
        // No clip moves the scene, and no mesh is deformed.
        scene.animation = Animation::default();
    }
    materials::convert(&document, &mut scene)?;
    let (light_nodes, lights) = lights::place(&document, &hierarchy, &order).into_iter().unzip();
    let (camera_nodes, cameras) = cameras::place(&document, &hierarchy, &order).into_iter().unzip();
    (scene.lights, scene.cameras) = (lights, cameras);
    let rig = &mut scene.animation.rig;
    if !rig.nodes.is_empty() {
        (rig.lights, rig.cameras) = (light_nodes, camera_nodes);
    }
    let remarks = document.remarks.take();
    finish(path, scene, remarks, |remarks| {
        let lost = ["dropped-triangles", "empty-mesh", "no-positions", "non-finite-instances"];
        let lost = remarks.sentence(&lost);
        if !lost.is_empty() {
            return Some(Empty::Dropped(lost));
        }
        hierarchy::without_meshes(&document, &order).map(Empty::Bare)
    })
}

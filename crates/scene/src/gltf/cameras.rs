//! Cameras of the nodes, in the world.

use std::f32::consts::PI;

use super::document::Document;
use super::hierarchy::Hierarchy;
use crate::pose::rigid;
use crate::{Camera, Projection};
use ::gltf::json::camera::{Camera as JsonCamera, Type};
use ::gltf::json::validation::Checked;

/// The cameras of the nodes in `order`, each with its node. Scale and shear of the nodes are taken off; aspect ratio
/// and clip planes of the file are not used: the image decides the one, rays need no other.
pub(super) fn place(document: &Document<'_>, hierarchy: &Hierarchy, order: &[usize]) -> Vec<(usize, Camera)> {
    let mut cameras = Vec::new();
    for &node in order {
        let Some(index) = document.root.nodes[node].camera else { continue };
        let source = &document.root.cameras[index.value()];
        let node_name = document.root.nodes[node].name.clone();
        let name =
            node_name.or_else(|| source.name.clone()).unwrap_or_else(|| format!("camera{}", cameras.len()));
        match (rigid(hierarchy.world[node]), projection(source)) {
            (Some(world_from_camera), Some(projection)) => {
                cameras.push((node, Camera { name, world_from_camera, projection }));
            }
            _ => {
                document.note("bad-camera", format!("camera {name}"), fault(document, index.value(), source))
            }
        }
    }
    cameras
}

/// Why a camera is dropped.
fn fault(document: &Document<'_>, index: usize, source: &JsonCamera) -> String {
    match source.type_ {
        Checked::Invalid => {
            format!("its type {}; it was dropped", document.unknown(&format!("cameras[{index}].type")))
        }
        Checked::Valid(_) => "its place or projection is degenerate; it was dropped".to_owned(),
    }
}

fn projection(source: &JsonCamera) -> Option<Projection> {
    match source.type_ {
        Checked::Valid(Type::Perspective) => {
            let fov_y = source.perspective.as_ref()?.yfov;
            (fov_y > 0.0 && fov_y < PI).then_some(Projection::Perspective { fov_y })
        }
        Checked::Valid(Type::Orthographic) => {
            let half_height = source.orthographic.as_ref()?.ymag.abs();
            (half_height > 0.0 && half_height.is_finite()).then_some(Projection::Orthographic { half_height })
        }
        Checked::Invalid => None,
    }
}

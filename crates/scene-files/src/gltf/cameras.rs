//! Cameras of the nodes, in the world.

use std::f32::consts::PI;

use super::document::Document;
use super::hierarchy::Hierarchy;
use ::gltf::json::camera::{Camera as JsonCamera, Type};
use ::gltf::json::validation::Checked;
use rasray_scene::pose::rigid;
use rasray_scene::{Camera, Projection};

/// Returns the cameras of the nodes in `order`, each with its node. Scale and shear of the nodes are removed.
/// Clip planes are not used: rays see at any distance.
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
                remark(document, index.value(), source);
                let aspect_ratio = aspect_ratio(source);
                cameras
                    .push((node, Camera { name, world_from_camera, projection, aspect_ratio, lens: None }));
            }
            (placed, _) => {
                let fault = fault(document, index.value(), source, placed.is_some());
                document.note("bad-camera", format!("camera {name}"), format!("{fault}; it was dropped"));
            }
        }
    }
    cameras
}

/// Returns the reason why a camera is dropped.
fn fault(document: &Document<'_>, index: usize, source: &JsonCamera, is_placed: bool) -> String {
    match (source.type_, &source.perspective, &source.orthographic) {
        (Checked::Invalid, ..) => {
            format!("its type {}", document.unknown(&format!("cameras[{index}].type")))
        }
        _ if projection(source).is_some() && !is_placed => {
            "its node looks in no direction: it has a scale of 0, or is not finite".to_owned()
        }
        (Checked::Valid(Type::Perspective), Some(perspective), _) => {
            format!("yfov {} is not between 0 and pi", perspective.yfov)
        }
        (Checked::Valid(Type::Orthographic), _, Some(parallel)) => {
            format!("ymag {} is no height", parallel.ymag)
        }
        (Checked::Valid(Type::Perspective), None, _) => "it has no perspective".to_owned(),
        (Checked::Valid(Type::Orthographic), _, None) => "it has no orthographic".to_owned(),
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

/// Returns the ratio of width to height of a camera's frame, if the file gives one.
fn aspect_ratio(source: &JsonCamera) -> Option<f32> {
    let ratio = match source.type_ {
        Checked::Valid(Type::Perspective) => source.perspective.as_ref()?.aspect_ratio?,
        Checked::Valid(Type::Orthographic) => {
            let parallel = source.orthographic.as_ref()?;
            (f64::from(parallel.xmag) / f64::from(parallel.ymag)).abs() as f32
        }
        Checked::Invalid => return None,
    };
    Some(ratio).filter(|ratio| *ratio > 0.0 && ratio.is_finite())
}

/// Notes remarks on properties of a camera that were not taken as they are.
fn remark(document: &Document<'_>, index: usize, source: &JsonCamera) {
    let note = |text: String| document.note("camera-range", format!("cameras[{index}]"), text);
    let sides = "the image decides what is seen at its sides";
    match source.type_ {
        Checked::Valid(Type::Perspective) => {
            let ratio = source.perspective.as_ref().and_then(|perspective| perspective.aspect_ratio);
            if let Some(ratio) = ratio.filter(|_| aspect_ratio(source).is_none()) {
                note(format!("aspectRatio {ratio} is not above 0; {sides}"));
            }
        }
        Checked::Valid(Type::Orthographic) => {
            let Some(parallel) = &source.orthographic else { return };
            for (name, value) in [("xmag", parallel.xmag), ("ymag", parallel.ymag)] {
                if value < 0.0 {
                    note(format!("{name} {value} is negative, and taken as {}", -value));
                }
            }
            if aspect_ratio(source).is_none() {
                note(format!("xmag {} is no width; {sides}", parallel.xmag));
            }
        }
        Checked::Invalid => {}
    }
}

//! `rasray info`.

use super::integrator_name;
use crate::arguments::InfoArguments;
use crate::backend::{DeviceDescription, Frame, OpenBackend};
use crate::error::AppError;
use crate::report::{Device, bytes, columns, grouped};
use crate::scene_source::LoadedScene;
use crate::{scene_source, terminal};
use rasray_scene::facing::Facing;
use rasray_scene::needs::Needs;
use rasray_scene::{Environment, Projection, default_view};
use std::fmt::Write;

/// Shows a scene, or without one the device.
///
/// # Errors
/// A scene that cannot be read, or no suitable device.
pub(crate) fn info(given: &InfoArguments, open: &mut OpenBackend<'_>) -> Result<(), AppError> {
    if let Some(name) = &given.scene {
        let mut loaded = scene_source::load(name)?;
        let frame = Frame { integrator: given.integrator.by_default(), width: 1, height: 1, spp: 1, seed: 0 };
        terminal::print(&scene_text(&loaded))?;
        // A render would light the scene; what it needs then is what counts.
        default_view::ensure_lit(&mut loaded.scene);
        terminal::print(&needs_text(&Needs::of(&loaded.scene, frame.workload()), integrator_name(&frame)))?;
        terminal::warn_of_scene(&loaded.scene, loaded.triangles);
        return Ok(());
    }
    let mut backend = open(&given.device.choice())?;
    let description = backend.info()?;
    terminal::print(&device_text(&backend.device(), &description))
}

fn pair(name: &str, value: impl ToString) -> Vec<String> {
    vec![name.to_owned(), value.to_string()]
}

fn scene_text(loaded: &LoadedScene) -> String {
    let scene = &loaded.scene;
    let environment = match &scene.environment {
        Environment::Constant(color) if color.iter().all(|channel| *channel == 0.0) => "none".to_owned(),
        Environment::Constant([r, g, b]) => format!("constant {r},{g},{b}"),
        Environment::LatLong { width, height, .. } => format!("map of {width}x{height}"),
    };
    let mut rows = vec![
        pair("triangles", grouped(loaded.triangles)),
        pair("instances", grouped(scene.instances.len() as u64)),
        pair("meshes", scene.meshes.len()),
        pair("materials", scene.materials.len()),
        pair("textures", scene.textures.len()),
        pair("lights", scene.lights.len()),
        pair("environment", environment),
        pair("clips", scene.animation.clips.len()),
    ];
    if let Some((low, high)) = default_view::bounds(scene) {
        let size = high - low;
        rows.push(pair("bounds", format!("{low:.3} to {high:.3} m")));
        rows.push(pair("size", format!("{:.3} x {:.3} x {:.3} m", size.x, size.y, size.z)));
    }
    if let Some(saved) = Facing::of(scene).saved_by_one_view() {
        rows.push(pair("one view of three", format!("saves {:.2} % of fragments at most", 100.0 * saved)));
    }
    if let Some(sha256) = &loaded.sha256 {
        rows.push(pair("sha256", sha256));
    }
    let mut text = format!("scene {}\n{}", scene.name, columns(&rows, 2));
    if !scene.cameras.is_empty() {
        text += "cameras\n";
        let rows: Vec<_> = scene
            .cameras
            .iter()
            .enumerate()
            .map(|(position, camera)| {
                let projection = match camera.projection {
                    Projection::Perspective { fov_y } => format!("{:.1} degrees", fov_y.to_degrees()),
                    Projection::Orthographic { half_height } => format!("{:.3} m high", 2.0 * half_height),
                };
                vec![position.to_string(), camera.name.clone(), projection]
            })
            .collect();
        text += &columns(&rows, 3);
    }
    text
}

fn needs_text(needs: &Needs, integrator: &str) -> String {
    let rows: Vec<_> = needs
        .verdicts()
        .iter()
        .map(|verdict| {
            let word = if verdict.needed { "needed" } else { "-" };
            vec![verdict.term.name().to_owned(), word.to_owned(), verdict.why.clone()]
        })
        .collect();
    let saved = bytes(needs.saved_bytes());
    format!("needs of --integrator {integrator}; not uploaded: {saved}\n{}", columns(&rows, 3))
}

fn device_text(device: &Device, description: &DeviceDescription) -> String {
    let kind = if device.software { "a program on the processor" } else { "hardware" };
    let mut text = String::from("devices\n");
    let rows: Vec<_> =
        description.devices.iter().enumerate().map(|(i, name)| vec![i.to_string(), name.clone()]).collect();
    text += &columns(&rows, 2);
    _ = writeln!(text, "in use");
    let rows = [
        pair("name", &device.name),
        pair("driver", &device.driver),
        pair("kind", kind),
        pair("Vulkan", &description.api_version),
    ];
    text += &columns(&rows, 2);
    if !description.features.is_empty() {
        text += "features\n";
        let rows: Vec<_> = description
            .features
            .iter()
            .map(|feature| {
                let state = match (feature.present, feature.required) {
                    (true, _) => "yes",
                    (false, true) => "MISSING",
                    (false, false) => "no",
                };
                let need = if feature.required { "required" } else { "optional" };
                vec![feature.name.clone(), state.to_owned(), need.to_owned(), feature.purpose.clone()]
            })
            .collect();
        text += &columns(&rows, 4);
    }
    if !description.limits.is_empty() {
        text += "limits\n";
        let rows: Vec<_> = description.limits.iter().map(|(name, value)| pair(name, value)).collect();
        text += &columns(&rows, 2);
    }
    if !description.paths.is_empty() {
        text += "paths\n";
        let rows: Vec<_> = description
            .paths
            .iter()
            .map(|path| {
                vec![path.system.clone(), path.choice.clone(), path.chosen.clone(), path.reason.clone()]
            })
            .collect();
        text += &columns(&rows, 4);
    }
    text
}

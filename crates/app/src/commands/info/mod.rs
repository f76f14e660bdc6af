//! `rasray info`.

mod device;
mod rows;
mod scene;
mod texels;

use crate::arguments::InfoArguments;
use crate::error::AppError;
use crate::progress::during;
use crate::terminal;
use rasray_experiment::{Frame, OpenBackend, Sampler, default_view, load};
use rasray_report::json_shown;
use serde_json::Value;

use super::steps::open_device;
use device::{device_json, device_text};
use scene::SceneInfo;

/// What the JSON is; fields are only ever added to version 1.
const SCHEMA: &str = "rasray-info/1";

/// Shows a scene, or without one the device.
///
/// # Errors
/// A scene that cannot be read, or no suitable device.
pub(crate) fn info(given: &InfoArguments, open: &mut OpenBackend<'_>) -> Result<(), AppError> {
    if let Some(name) = &given.scene {
        let mut loaded = during("scene", "reading", || load(name))?;
        let frame = Frame {
            integrator: given.integrator.by_default(),
            width: 1,
            height: 1,
            spp: 1,
            seed: 0,
            sampler: Sampler::Sobol,
        };
        let view = during("scene", "looking for a view", || default_view(&loaded.scene));
        let room = || open_device(open, &given.device).map(|backend| backend.texel_room());
        let info = SceneInfo::of(&mut loaded, &view, &frame, room)?;
        show(given.json, || info.json(), || info.text())?;
        terminal::warn_of_scene(&loaded.scene, loaded.triangles);
        return Ok(());
    }
    let mut backend = open_device(open, &given.device)?;
    let description = backend.info()?;
    let device = backend.device();
    show(given.json, || device_json(&device, &description), || device_text(&device, &description))
}

/// Prints the one form or the other.
fn show(as_json: bool, json: impl Fn() -> Value, text: impl Fn() -> String) -> Result<(), AppError> {
    if !as_json {
        return terminal::print(&text());
    }
    let mut whole = serde_json::Map::from_iter([("schema".to_owned(), Value::from(SCHEMA))]);
    if let Value::Object(fields) = json() {
        whole.extend(fields);
    }
    let text = serde_json::to_string_pretty(&whole).expect("names and numbers");
    terminal::print(&format!("{}\n", json_shown(&text)))
}

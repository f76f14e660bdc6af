//! Command `rasray info`.

mod device;
mod lists;
mod passes;
mod rows;
mod scene;

use crate::arguments::InfoArguments;
use crate::error::AppError;
use crate::progress::during;
use crate::terminal;
use rasray_experiment::{
    AovSelection, Frame, OccluderKind, OpenBackend, Primary, Refresh, RenderJob, Sampler, SceneInfo,
};
use rasray_report::json_escaped;
use rasray_scene::BackFaces;
use rasray_scene::needs::Needs;
use rasray_scene_source::default_view;
use serde_json::Value;

use super::steps::{fit_images, load_scene, open_device};
use device::{device_json, device_text};
use lists::{lists_json, lists_text};
use passes::{passes_json, passes_text};
use scene::scene_text;

/// Schema of the JSON; version 1 only ever gains fields.
const SCHEMA: &str = "rasray-info/1";

/// Side of the images for which passes are listed, pixels: a structure that draws the camera's view has as
/// many cells.
const SIDE: u32 = 512;

/// Shows a scene, the passes or the lists of a structure on it, or without a scene the device.
///
/// # Errors
/// The scene cannot be read, no device is suitable, or options belong to no structure.
pub(crate) fn info(given: &InfoArguments, open: &mut OpenBackend<'_>) -> Result<(), AppError> {
    let system = given.system()?;
    if let Some(name) = &given.scene {
        let mut loaded = during("scene", "reading", || load_scene(name, given.fps, false))?;
        if let Some(seconds) = given.time {
            during("scene", "posing", || loaded.pose(seconds, given.clip.as_deref()))?;
        }
        let frame = Frame {
            integrator: given.integrator.into(),
            width: 1,
            height: 1,
            spp: 1,
            adaptive: None,
            seed: 0,
            sampler: Sampler::Sobol,
            primary: Primary::Trace,
            occluder: OccluderKind::Structure,
            back_faces: BackFaces::Camera,
        };
        let view = during("scene", "looking for a view", || default_view(&loaded.scene));
        if let Some(system) = system {
            loaded.light(None);
            let frame = Frame { width: SIDE, height: SIDE, ..frame };
            let system = system.serving(frame.workload()).seen_by(&view.camera, &frame);
            let mut backend = open_device(open, &given.device)?;
            let needs = Needs::of(&loaded.scene, frame.workload());
            fit_images(&mut loaded, &needs, backend.as_ref())?;
            let job = RenderJob {
                moment: None,
                scene: &loaded.scene,
                camera: view.camera,
                system,
                refresh: Refresh::All,
                frame,
                shard: None,
                aovs: AovSelection::default(),
                before: None,
                needs,
                repetitions: 0,
            };
            if given.statistics {
                let lists = during("statistics", "building", || backend.lists(&job))?;
                return show(given.json, || lists_json(&lists), || lists_text(&lists));
            }
            let passes = during("passes", "building", || backend.passes(&job))?;
            return show(given.json, || passes_json(&passes), || passes_text(&passes));
        }
        let capacity = || open_device(open, &given.device).ok().map(|backend| backend.texel_capacity());
        let info = SceneInfo::of(&mut loaded, &view, &frame, capacity)?;
        show(given.json, || info.json(), || scene_text(&info))?;
        terminal::warn_of_scene(&loaded.scene, loaded.triangles);
        return Ok(());
    }
    let mut backend = open_device(open, &given.device)?;
    let description = backend.info()?;
    let device = backend.device();
    show(given.json, || device_json(&device, &description), || device_text(&device, &description))
}

/// Prints the JSON or the text.
fn show(as_json: bool, json: impl Fn() -> Value, text: impl Fn() -> String) -> Result<(), AppError> {
    if !as_json {
        return terminal::print(&text());
    }
    let mut whole = serde_json::Map::from_iter([("schema".to_owned(), Value::from(SCHEMA))]);
    if let Value::Object(fields) = json() {
        whole.extend(fields);
    }
    let text = serde_json::to_string_pretty(&whole).expect("names and numbers");
    terminal::print(&format!("{}\n", json_escaped(&text)))
}

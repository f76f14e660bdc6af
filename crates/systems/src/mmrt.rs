//! MMRT: the A-buffer with the paper's presets.

use rasray_abuffer::{
    ABuffer, Accept, Addressing, Bounds, Builder, Config, Coverage, March, Payload, Storage, ViewSwitching,
    Views,
};

use crate::option_value::{OptionValue, Setter, names};
use crate::{PaperFrame, Preset, Spec, System, SystemsError};

/// Row of this system in [`SYSTEMS`](crate::SYSTEMS).
pub(crate) const SYSTEM: System = System {
    name: "mmrt",
    doc: "A-buffers on the faces of a cube and on the camera's view",
    structure: "abuffer",
    records: ABuffer::RECORDS,
    large_pools: &[("resolution", "2400")],
    presets: &[Preset::Robust, Preset::Published],
    frame: Some(PaperFrame {
        occluder: "shadow-maps",
        occlusion_payload: Some("normal"),
        camera_views: Some("cube+camera"),
        ..PaperFrame::of("path", &[])
    }),
    without_scene: &[("payload", "index")],
    options: || names(OPTIONS),
    requirements: |spec| Ok(ABuffer::requirements_of(&config(spec)?)),
    kind: |spec| Ok(ABuffer::kind_of(&config(spec)?)),
    create: |spec, device, geometry, scene| {
        Ok(Box::new(ABuffer::new(device, config(spec)?, geometry, scene)?))
    },
};

/// Setters of the options, by name.
const OPTIONS: &[Setter<Config>] = &[
    ("resolution", |config, given| given.whole().map(|value| config.resolution = value)),
    ("buckets", |config, given| given.whole().map(|value| config.buckets = value)),
    ("samples", |config, given| given.whole().map(|value| config.samples = value)),
    ("capacity", |config, given| given.whole().map(|value| config.fragments = Some(value.into()))),
    ("thickness", |config, given| given.number().map(|value| config.thickness = Some(value))),
    ("jitter", |config, given| given.switch().map(|value| config.jitter = value)),
    ("single-layer", |config, given| given.switch().map(|value| config.single_layer = value)),
    ("sort", |config, given| given.switch().map(|value| config.sort = value)),
    ("skip", |config, given| given.switch().map(|value| config.skip = value)),
    ("storage", |config, given| given.choice(Storage::WORDS).map(|value| config.storage = value)),
    ("bounds", |config, given| given.choice(Bounds::WORDS).map(|value| config.bounds = value)),
    ("builder", |config, given| given.choice(Builder::WORDS).map(|value| config.builder = value)),
    ("inline", |config, given| given.switch().map(|value| config.inline = value)),
    ("page", |config, given| given.whole().map(|value| config.page = value)),
    ("views", |config, given| given.choice(Views::WORDS).map(|value| config.views = value)),
    ("view-switching", |config, given| {
        given.choice(ViewSwitching::WORDS).map(|value| config.view_switching = value)
    }),
    ("camera-resolution", |config, given| given.cells().map(|value| config.camera_resolution = value)),
    ("ids", |config, given| given.switch().map(|value| config.ids = value)),
    ("payload", |config, given| given.choice(Payload::WORDS).map(|value| config.payload = value)),
    ("march", |config, given| given.choice(March::WORDS).map(|value| config.march = value)),
    ("accept", |config, given| given.choice(Accept::WORDS).map(|value| config.accept = value)),
    ("coverage", |config, given| given.choice(Coverage::WORDS).map(|value| config.coverage = value)),
    ("addressing", |config, given| given.choice(Addressing::WORDS).map(|value| config.addressing = value)),
];

/// Default number of cells along a side of a face.
const RESOLUTION: u32 = 512;

/// Returns the configuration for a spec.
pub(crate) fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let mut config = match spec.preset() {
        Preset::Robust => Config::robust(RESOLUTION),
        Preset::Published => Config::published(RESOLUTION),
    };
    config.counters = spec.counters();
    config.work_budget = spec.work_budget();
    OptionValue::apply_all(spec, OPTIONS, &mut config)?;
    let given = |option| spec.options().get(option).is_some();
    if spec.preset() == Preset::Robust {
        // Some options need other defaults than the preset's: options that exclude conservative coverage need
        // exact coverage, and buckets, or boxes that bound buckets, need a storage with buckets.
        if !given("coverage") && !config.may_test_triangles() {
            config.coverage = Coverage::Exact;
        }
        if !given("storage") && (given("buckets") || config.bounds == Bounds::Boxes) {
            config.storage = Storage::Dllb;
        }
    }
    if spec.options().get("camera-resolution").is_none() {
        config.camera_resolution = [config.resolution; 2];
    }
    config.validate()?;
    Ok(config)
}

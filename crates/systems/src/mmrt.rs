//! MMRT: the A-buffer with the paper's presets.

use rasray_abuffer::{ABuffer, Accept, Builder, Config, Coverage, March, Payload, Storage, Views};

use crate::option::Given;
use crate::{Preset, Spec, System, SystemsError};

/// The registry's row.
pub(crate) const SYSTEM: System = System {
    name: "mmrt",
    structure: |_| "abuffer",
    presets: &[Preset::Robust, Preset::Published],
    occlusion_payload: Some("normal"),
    camera_views: Some("cube+camera"),
    options: &OPTIONS,
    requirements: |spec| Ok(ABuffer::requirements_of(&config(spec)?)),
    kind: |spec| Ok(ABuffer::kind_of(&config(spec)?)),
    create: |spec, device, geometry, scene| {
        Ok(Box::new(ABuffer::new(device, config(spec)?, geometry, scene)?))
    },
};

/// Options by their names on the command line.
const OPTIONS: [&str; 21] = [
    "resolution",
    "buckets",
    "single-layer",
    "storage",
    "inline",
    "page",
    "payload",
    "ids",
    "march",
    "samples",
    "jitter",
    "accept",
    "thickness",
    "coverage",
    "sort",
    "skip",
    "builder",
    "views",
    "camera-resolution",
    "addressing",
    "capacity",
];

/// Cells a side where nothing else is asked for.
const RESOLUTION: u32 = 512;

/// The configuration that a spec stands for.
pub(crate) fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let mut config = match spec.preset() {
        Preset::Robust => Config::robust(RESOLUTION),
        Preset::Published => Config::published(RESOLUTION),
    };
    config.counters = spec.counters();
    config.work_budget = spec.work_budget();
    for given in Given::all(spec) {
        match given.name {
            "resolution" => config.resolution = given.number()?,
            "buckets" => config.buckets = given.number()?,
            "samples" => config.samples = given.number()?,
            "capacity" => config.fragments = Some(given.number()?.into()),
            "thickness" => config.thickness = Some(given.length()?),
            "jitter" => config.jitter = given.switch()?,
            "single-layer" => config.single_layer = given.switch()?,
            "sort" => config.sort = given.switch()?,
            "skip" => config.skip = given.switch()?,
            "storage" => {
                config.storage = given.choice(&Storage::ALL.map(|storage| (storage.name(), storage)))?;
            }
            "builder" => {
                config.builder = given.choice(&Builder::ALL.map(|builder| (builder.name(), builder)))?;
            }
            "inline" => config.inline = given.switch()?,
            "page" => config.page = given.number()?,
            "views" => config.views = given.choice(&Views::ALL.map(|views| (views.name(), views)))?,
            "camera-resolution" => config.camera_resolution = given.cells()?,
            "ids" => config.ids = given.switch()?,
            "payload" => {
                config.payload = given.choice(&Payload::ALL.map(|payload| (payload.name(), payload)))?;
            }
            "march" => {
                config.march = given.choice(&[
                    ("samples", March::Samples),
                    ("dda", March::Dda),
                    ("exact", March::Exact),
                    ("pyramid", March::Pyramid),
                ])?;
            }
            "accept" => {
                config.accept = given.choice(&[
                    ("interval", Accept::Interval),
                    ("thickness", Accept::Thickness),
                    ("slope", Accept::Slope),
                    ("plane", Accept::Plane),
                ])?;
            }
            "coverage" => {
                config.coverage = given.choice(&Coverage::ALL.map(|coverage| (coverage.name(), coverage)))?;
            }
            "addressing" => config.addressing = given.addressing()?,
            _ => return Err(given.unknown()),
        }
    }
    if !spec.options().contains_key("camera-resolution") {
        config.camera_resolution = [config.resolution; 2];
    }
    config.validate()?;
    Ok(config)
}

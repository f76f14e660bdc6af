//! DIRT: primitive lists with the paper's presets.

use rasray_primitive::{
    Accept, Addressing, Builder, Centre, Config, Coverage, Depths, March, PrimitiveLists, PyramidStart, Stop,
    Storage, Views,
};

use crate::option_value::{OptionValue, Setter, names};
use crate::{PaperFrame, Preset, Spec, System, SystemsError};

/// Row of this system in [`SYSTEMS`](crate::SYSTEMS).
pub(crate) const SYSTEM: System = System {
    name: "dirt",
    doc: "Lists of triangles per tile of a cube's faces: hits are those of the triangles",
    structure: "primitive",
    records: PrimitiveLists::RECORDS,
    large_pools: &[("tile", "1"), ("resolution", "1024"), ("buckets", "8")],
    presets: &[Preset::Robust, Preset::Published],
    frame: Some(PaperFrame::of("path", &[("fetch", "raster")])),
    without_scene: &[],
    options: || names(OPTIONS),
    requirements: |spec| Ok(PrimitiveLists::requirements_of(&config(spec)?)),
    kind: |spec| Ok(PrimitiveLists::kind_of(&config(spec)?)),
    create: |spec, device, geometry, scene| {
        Ok(Box::new(PrimitiveLists::new(device, config(spec)?, geometry, scene)?))
    },
};

/// Setters of the options, by name.
const OPTIONS: &[Setter<Config>] = &[
    ("resolution", |config, given| given.whole().map(|value| config.resolution = value)),
    ("tile", |config, given| given.whole().map(|value| config.tile = value)),
    ("buckets", |config, given| given.whole().map(|value| config.buckets = value)),
    ("capacity", |config, given| given.whole().map(|value| config.entries = Some(value.into()))),
    ("skip", |config, given| given.switch().map(|value| config.skip = value)),
    ("storage", |config, given| given.choice(Storage::WORDS).map(|value| config.storage = value)),
    ("coverage", |config, given| given.choice(Coverage::WORDS).map(|value| config.coverage = value)),
    ("accept", |config, given| given.choice(Accept::WORDS).map(|value| config.accept = value)),
    ("stop", |config, given| given.choice(Stop::WORDS).map(|value| config.stop = value)),
    ("depths", |config, given| given.choice(Depths::WORDS).map(|value| config.depths = value)),
    ("march", |config, given| given.choice(March::WORDS).map(|value| config.march = value)),
    ("pyramid", |config, given| given.switch().map(|value| config.pyramid = value)),
    ("pyramid-start", |config, given| {
        given.choice(PyramidStart::WORDS).map(|value| config.pyramid_start = value)
    }),
    ("views", |config, given| given.choice(Views::WORDS).map(|value| config.views = value)),
    ("centre", |config, given| given.choice(Centre::WORDS).map(|value| config.centre = value)),
    ("builder", |config, given| given.choice(Builder::WORDS).map(|value| config.builder = value)),
    ("addressing", |config, given| given.choice(Addressing::WORDS).map(|value| config.addressing = value)),
];

/// Default number of pixels along a side of a face.
const RESOLUTION: u32 = 256;

/// Number of pixels along a side of a face in the paper's second table.
const PUBLISHED_RESOLUTION: u32 = 512;

/// Returns the configuration for a spec.
pub(crate) fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let mut config = match spec.preset() {
        Preset::Robust => Config::robust(RESOLUTION),
        Preset::Published => Config::published(PUBLISHED_RESOLUTION),
    };
    config.counters = spec.counters();
    config.work_budget = spec.work_budget();
    OptionValue::apply_all(spec, OPTIONS, &mut config)?;
    // The rasterizer makes all coverages but the conservative one.
    if spec.options().get("builder").is_none() && config.coverage != Coverage::Conservative {
        config.builder = Builder::Raster;
    }
    config.validate()?;
    Ok(config)
}

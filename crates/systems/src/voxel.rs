//! Options of the systems that trace voxels with axis A-buffers.

use rasray_voxel::{
    Accept, Addressing, Axes, Builder, Config, Coverage, Ends, Inside, Leaves, March, Marking, Payload,
    Storage, Traversal,
};

use crate::option_value::{OptionValue, Setter};
use crate::{Spec, SystemsError};

/// Setters of the options, by name.
const OPTIONS: &[Setter<Config>] = &[
    ("resolution", |config, given| given.whole().map(|value| config.resolution = value)),
    ("grid", |config, given| given.whole().map(|value| config.grid = Some(value))),
    ("samples", |config, given| given.whole().map(|value| config.samples = value)),
    ("page", |config, given| given.whole().map(|value| config.page = value)),
    ("capacity", |config, given| given.whole().map(|value| config.fragments = Some(value.into()))),
    ("sort", |config, given| given.switch().map(|value| config.sort = value)),
    ("builder", |config, given| given.choice(Builder::WORDS).map(|value| config.builder = value)),
    ("axes", |config, given| given.choice(Axes::WORDS).map(|value| config.axes = value)),
    ("voxels", |config, given| given.choice(Marking::WORDS).map(|value| config.voxels = Some(value))),
    ("leaves", |config, given| given.choice(Leaves::WORDS).map(|value| config.leaves = value)),
    ("traversal", |config, given| given.choice(Traversal::WORDS).map(|value| config.traversal = value)),
    ("march", |config, given| given.choice(March::WORDS).map(|value| config.march = value)),
    ("accept", |config, given| given.choice(Accept::WORDS).map(|value| config.accept = value)),
    ("ends", |config, given| given.choice(Ends::WORDS).map(|value| config.ends = value)),
    ("inside", |config, given| given.choice(Inside::WORDS).map(|value| config.inside = value)),
    ("ids", |config, given| given.switch().map(|value| config.ids = value)),
    // Attributes are those of the system's paper, which `config` sets afterwards.
    ("payload", |config, given| {
        given
            .choice(&[("index", Payload::Index), ("attributes", Payload::Material)])
            .map(|value| config.payload = value)
    }),
    ("coverage", |config, given| given.choice(Coverage::WORDS).map(|value| config.coverage = value)),
    ("storage", |config, given| given.choice(Storage::WORDS).map(|value| config.storage = value)),
    ("addressing", |config, given| given.choice(Addressing::WORDS).map(|value| config.addressing = value)),
];

/// Returns the names of the options.
pub(crate) fn names() -> Vec<&'static str> {
    crate::option_value::names(OPTIONS)
}

/// Default number of cells along a side of a view of the repaired structure.
pub(crate) const RESOLUTION: u32 = 512;

/// Number of voxels along a side in both papers. With a resolution other than the paper's, the number follows
/// the rule of Hu et al.
pub(crate) const PUBLISHED_GRID: u32 = 64;

/// Returns a preset with the number of voxels of its paper, if the resolution is the paper's.
pub(crate) fn of_the_paper(spec: &Spec, preset: Config) -> Config {
    let given = spec.options().get("resolution");
    Config { grid: given.is_none().then_some(PUBLISHED_GRID), ..preset }
}

/// Returns the configuration for a spec over a preset. `attributes` is the payload of the system's paper.
pub(crate) fn config(spec: &Spec, preset: Config, attributes: Payload) -> Result<Config, SystemsError> {
    let mut config = preset;
    config.counters = spec.counters();
    config.work_budget = spec.work_budget();
    OptionValue::apply_all(spec, OPTIONS, &mut config)?;
    // Options that exclude conservative coverage need exact coverage as the default.
    let is_default = spec.options().get("coverage").is_none();
    if is_default && config.coverage == Coverage::Conservative && !config.may_test_triangles() {
        config.coverage = Coverage::Exact;
    }
    if config.payload != Payload::Index {
        config.payload = attributes;
    }
    config.validate()?;
    Ok(config)
}

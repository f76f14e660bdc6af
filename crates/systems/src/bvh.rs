//! Bounding volume hierarchies: the baseline.

use rasray_bvh::{Addressing, Builder, Bvh, Children, Config};

use crate::option_value::{OptionValue, Setter, names};
use crate::{Preset, Spec, System, SystemsError};

/// Row of this system in [`SYSTEMS`](crate::SYSTEMS).
pub(crate) const SYSTEM: System = System {
    name: "bvh",
    doc: "A bounding volume hierarchy: the baseline",
    structure: "bvh",
    records: Bvh::RECORDS,
    large_pools: &[],
    presets: &[Preset::Robust],
    frame: None,
    without_scene: &[],
    options: || names(OPTIONS),
    requirements: |spec| Ok(Bvh::requirements_of(&config(spec)?)),
    kind: |spec| Ok(Bvh::kind_of(&config(spec)?)),
    create: |spec, device, geometry, scene| Ok(Box::new(Bvh::new(device, config(spec)?, geometry, scene)?)),
};

/// Setters of the options, by name.
const OPTIONS: &[Setter<Config>] = &[
    ("builder", |config, given| given.choice(Builder::WORDS).map(|value| config.builder = value)),
    ("children", |config, given| given.choice(Children::WORDS).map(|value| config.children = Some(value))),
    ("leaf", |config, given| given.whole().map(|value| config.leaf = Some(value))),
    ("addressing", |config, given| given.choice(Addressing::WORDS).map(|value| config.addressing = value)),
];

/// Returns the configuration for a spec.
fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let mut config = Config::new(Builder::Sah);
    config.counters = spec.counters();
    config.work_budget = spec.work_budget();
    OptionValue::apply_all(spec, OPTIONS, &mut config)?;
    config.validate()?;
    Ok(config)
}

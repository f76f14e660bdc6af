//! The driver's own tree: the structure that hardware for ray tracing accelerates, for comparison.

use rasray_driver::{Config, Driver, Goal};

use crate::option_value::{OptionValue, Setter, names};
use crate::{Preset, Spec, System, SystemsError};

/// Row of this system in [`SYSTEMS`](crate::SYSTEMS).
pub(crate) const SYSTEM: System = System {
    name: "driver-rt",
    doc: "The driver's own tree over boxes, by ray queries: devices with VK_KHR_ray_query alone",
    structure: "driver",
    records: Driver::RECORDS,
    large_pools: &[],
    presets: &[Preset::Robust],
    frame: None,
    without_scene: &[],
    options: || names(OPTIONS),
    requirements: |spec| Ok(Driver::requirements_of(&config(spec)?)),
    kind: |spec| Ok(Driver::kind_of(&config(spec)?)),
    create: |spec, device, geometry, scene| {
        Ok(Box::new(Driver::new(device, config(spec)?, geometry, scene)?))
    },
};

/// Setters of the options, by name.
const OPTIONS: &[Setter<Config>] =
    &[("goal", |config, given| given.choice(Goal::WORDS).map(|value| config.goal = value))];

/// Returns the configuration for a spec.
fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let mut config =
        Config { counters: spec.counters(), work_budget: spec.work_budget(), ..Config::default() };
    OptionValue::apply_all(spec, OPTIONS, &mut config)?;
    config.validate()?;
    Ok(config)
}

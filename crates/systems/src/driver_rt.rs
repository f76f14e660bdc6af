//! The driver's own tree: what hardware for ray tracing has to be compared with.

use rasray_driver::{Config, Driver, Goal};

use crate::option_value::{OptionValue, Setter, names};
use crate::{Preset, Spec, System, SystemsError};

/// The registry's row.
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

/// Options, each with what it sets.
const OPTIONS: &[Setter<Config>] =
    &[("goal", |config, given| given.choice(Goal::WORDS).map(|value| config.goal = value))];

/// The configuration that a spec stands for.
fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let mut config =
        Config { counters: spec.counters(), work_budget: spec.work_budget(), ..Config::default() };
    OptionValue::apply_all(spec, OPTIONS, &mut config)?;
    config.validate()?;
    Ok(config)
}

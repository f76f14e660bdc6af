//! The uniform grid: the baseline for structures made of cells.

use rasray_grid::{Addressing, Config, Grid};

use crate::option_value::{OptionValue, Setter, names};
use crate::{Preset, Spec, System, SystemsError};

/// Row of this system in [`SYSTEMS`](crate::SYSTEMS).
pub(crate) const SYSTEM: System = System {
    name: "grid",
    doc: "A plain uniform grid with a list of triangles per cell, the baseline of structures made of cells",
    structure: "grid",
    records: Grid::RECORDS,
    large_pools: &[("grid", "400")],
    presets: &[Preset::Robust],
    frame: None,
    without_scene: &[],
    options: || names(OPTIONS),
    requirements: |spec| Ok(Grid::requirements_of(&config(spec)?)),
    kind: |spec| Ok(Grid::kind_of(&config(spec)?)),
    create: |spec, device, geometry, scene| Ok(Box::new(Grid::new(device, config(spec)?, geometry, scene)?)),
};

/// Setters of the options, by name.
const OPTIONS: &[Setter<Config>] = &[
    ("grid", |config, given| given.whole().map(|value| config.cells = Some(value))),
    ("addressing", |config, given| given.choice(Addressing::WORDS).map(|value| config.addressing = value)),
    ("capacity", |config, given| given.whole().map(|value| config.entries = Some(value.into()))),
];

/// Returns the configuration for a spec.
fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let mut config =
        Config { counters: spec.counters(), work_budget: spec.work_budget(), ..Config::default() };
    OptionValue::apply_all(spec, OPTIONS, &mut config)?;
    config.validate()?;
    Ok(config)
}

//! Bricks: a structure that no paper describes.

use rasray_bricks::{Addressing, Bricks, Builder, Config, Views};

use crate::option_value::{OptionValue, Setter, names};
use crate::{Preset, Spec, System, SystemsError};

/// Row of this system in [`SYSTEMS`](crate::SYSTEMS).
pub(crate) const SYSTEM: System = System {
    name: "bricks",
    doc: "Cells with lists of triangles, in bricks that skip empty space: hits are those of the triangles",
    structure: "bricks",
    records: Bricks::RECORDS,
    large_pools: &[("views", "cube"), ("grid", "512"), ("slices", "512")],
    presets: &[Preset::Robust],
    frame: None,
    without_scene: &[],
    options: || names(OPTIONS),
    requirements: |spec| Ok(Bricks::requirements_of(&config(spec)?)),
    kind: |spec| Ok(Bricks::kind_of(&config(spec)?)),
    create: |spec, device, geometry, scene| {
        Ok(Box::new(Bricks::new(device, config(spec)?, geometry, scene)?))
    },
};

/// Setters of the options, by name.
const OPTIONS: &[Setter<Config>] = &[
    ("views", |config, given| given.choice(Views::WORDS).map(|value| config.views = value)),
    ("grid", |config, given| given.whole().map(|value| config.grid = Some(value))),
    ("divisions", |config, given| given.whole().map(|value| config.divisions = Some(value))),
    ("slices", |config, given| given.whole().map(|value| config.slices = Some(value))),
    ("corners", |config, given| given.switch().map(|value| config.corners = value)),
    ("skip", |config, given| given.switch().map(|value| config.skip = value)),
    ("builder", |config, given| given.choice(Builder::WORDS).map(|value| config.builder = value)),
    ("addressing", |config, given| given.choice(Addressing::WORDS).map(|value| config.addressing = value)),
    ("capacity", |config, given| given.whole().map(|value| config.entries = Some(value.into()))),
];

/// Returns the configuration for a spec.
fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let mut config = Config::new(Views::Axes);
    config.counters = spec.counters();
    config.work_budget = spec.work_budget();
    OptionValue::apply_all(spec, OPTIONS, &mut config)?;
    config.validate()?;
    Ok(config)
}

//! LDC: the layered depth cube with the paper's presets.

use rasray_ldc::{
    Accept, Addressing, Builder, Config, Coverage, Depth, Ends, LayeredDepthCube, Making, Occupancy, Payload,
};

use crate::option_value::{OptionValue, Setter, names};
use crate::{PaperFrame, Preset, Spec, System, SystemsError};

/// Row of this system in [`SYSTEMS`](crate::SYSTEMS).
pub(crate) const SYSTEM: System = System {
    name: "ldc",
    doc: "Layers of fragments along three axes, each triangle along the one it faces most",
    structure: "ldc",
    records: LayeredDepthCube::RECORDS,
    large_pools: &[("resolution", "2400")],
    presets: &[Preset::Robust, Preset::Published],
    frame: Some(PaperFrame::of(
        "whitted",
        &[("select", "specular"), ("ray-depth", "1"), ("mirror-roughness", "0.3")],
    )),
    without_scene: &[("payload", "index")],
    options: || names(OPTIONS),
    requirements: |spec| Ok(LayeredDepthCube::requirements_of(&config(spec)?)),
    kind: |spec| Ok(LayeredDepthCube::kind_of(&config(spec)?)),
    create: |spec, device, geometry, scene| {
        Ok(Box::new(LayeredDepthCube::new(device, config(spec)?, geometry, scene)?))
    },
};

/// Setters of the options, by name.
const OPTIONS: &[Setter<Config>] = &[
    ("resolution", |config, given| given.whole().map(|value| config.resolution = value)),
    ("block", |config, given| given.cells().map(|value| config.block = value)),
    ("layers", |config, given| given.whole().map(|value| config.layers = value)),
    ("build", |config, given| given.choice(Making::WORDS).map(|value| config.making = value)),
    ("levels", |config, given| given.whole().map(|value| config.levels = value)),
    ("occupancy", |config, given| given.choice(Occupancy::WORDS).map(|value| config.occupancy = value)),
    ("capacity", |config, given| given.whole().map(|value| config.fragments = Some(value.into()))),
    ("tolerance", |config, given| given.number().map(|value| config.tolerance = value)),
    ("skip", |config, given| given.switch().map(|value| config.skip = value)),
    ("builder", |config, given| given.choice(Builder::WORDS).map(|value| config.builder = value)),
    ("geometry-passes", |config, given| {
        given.choice(&[("1", 1), ("3", 3)]).map(|value| config.passes = value)
    }),
    // These two options have a single word, so they are checked and select nothing.
    ("storage", |_, given| given.choice(&[("sb", ())])),
    ("views", |_, given| given.choice(&[("axes", ())])),
    ("ids", |config, given| given.switch().map(|value| config.ids = value)),
    ("payload", |config, given| given.choice(Payload::WORDS).map(|value| config.payload = value)),
    ("depth", |config, given| given.choice(Depth::WORDS).map(|value| config.depth = value)),
    ("accept", |config, given| given.choice(Accept::WORDS).map(|value| config.accept = value)),
    ("ends", |config, given| given.choice(Ends::WORDS).map(|value| config.ends = value)),
    ("coverage", |config, given| given.choice(Coverage::WORDS).map(|value| config.coverage = value)),
    ("addressing", |config, given| given.choice(Addressing::WORDS).map(|value| config.addressing = value)),
];

/// Default number of cells along a side of a view.
const RESOLUTION: u32 = 512;

/// Number of cells along a side of a view: the larger of the two sizes in the paper's table.
const PUBLISHED_RESOLUTION: u32 = 1024;

/// Returns the configuration for a spec.
pub(crate) fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let mut config = match spec.preset() {
        Preset::Robust => Config::robust(RESOLUTION),
        Preset::Published => Config::published(PUBLISHED_RESOLUTION),
    };
    config.counters = spec.counters();
    config.work_budget = spec.work_budget();
    OptionValue::apply_all(spec, OPTIONS, &mut config)?;
    // Rays can test triangles only with conservative coverage; with others the default is their planes.
    let is_default = spec.options().get("accept").is_none();
    if is_default && config.accept == Accept::Triangle && config.coverage != Coverage::Conservative {
        config.accept = Accept::Plane;
    }
    config.validate()?;
    Ok(config)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn accepted(options: &[(&str, &str)]) -> Result<Accept, SystemsError> {
        let given = options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
        config(&Spec::new("ldc", "robust", given)?).map(|config| config.accept)
    }

    #[test]
    fn triangles_are_hit_unless_another_coverage_asks_for_planes() {
        let found = |options| accepted(options).expect("the options are valid");
        assert_eq!(found(&[]), Accept::Triangle);
        assert_eq!(found(&[("coverage", "exact")]), Accept::Plane);
        assert_eq!(found(&[("coverage", "conservative")]), Accept::Triangle);
        let refused = accepted(&[("coverage", "exact"), ("accept", "triangle")]).expect_err("holes");
        assert!(refused.to_string().contains("accept"), "{refused}");
    }
}

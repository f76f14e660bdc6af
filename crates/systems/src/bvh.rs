//! Bounding volume hierarchies: the baseline.

use rasray_bvh::{Builder, Bvh, Config};

use crate::option::Given;
use crate::{Preset, Spec, System, SystemsError};

/// The registry's row.
pub(crate) const SYSTEM: System = System {
    name: "bvh",
    structure: |_| "bvh",
    presets: &[Preset::Robust],
    occlusion_payload: None,
    camera_views: None,
    options: &["builder", "leaf", "addressing"],
    requirements: |spec| Ok(Bvh::requirements_of(&config(spec)?)),
    kind: |spec| Ok(Bvh::kind_of(&config(spec)?)),
    create: |spec, device, geometry, scene| Ok(Box::new(Bvh::new(device, config(spec)?, geometry, scene)?)),
};

/// The configuration that a spec stands for.
fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let mut config = Config::new(Builder::Sah);
    config.counters = spec.counters();
    config.work_budget = spec.work_budget();
    for given in Given::all(spec) {
        match given.name {
            "builder" => config.builder = given.choice(&[("sah", Builder::Sah), ("lbvh", Builder::Lbvh)])?,
            "leaf" => config.leaf = given.number()?,
            "addressing" => config.addressing = given.addressing()?,
            _ => return Err(given.unknown()),
        }
    }
    config.validate()?;
    Ok(config)
}

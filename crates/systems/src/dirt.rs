//! DIRT: primitive lists with the paper's presets.

use rasray_ads_primitive::{Addressing, Config, PrimitiveLists, Storage};

use crate::option::Given;
use crate::{Preset, Spec, System, SystemsError};

/// The registry's row.
pub(crate) const SYSTEM: System = System {
    name: "dirt",
    structure: "ads-primitive",
    presets: &[Preset::Robust],
    options: &OPTIONS,
    requirements: |spec| Ok(PrimitiveLists::requirements_of(&config(spec, 0)?)),
    create: |spec, device, geometry, scene| {
        let config = config(spec, geometry.triangle_count())?;
        Ok(Box::new(PrimitiveLists::new(device, config, geometry, scene)?))
    },
};

/// Options by their names on the command line.
const OPTIONS: [&str; 10] = [
    "resolution",
    "tile",
    "buckets",
    "slices",
    "storage",
    "corners",
    "skip",
    "views",
    "addressing",
    "capacity",
];

/// Pixels a side of a face where lists are asked for and nothing else is.
const RESOLUTION: u32 = 256;

/// The configuration that a spec stands for, for a geometry of that many triangles.
fn config(spec: &Spec, triangles: u32) -> Result<Config, SystemsError> {
    let mut config = Config::robust_for(triangles);
    let lists = Given::all(spec).any(|given| given.name == "storage" && given.is_not("bricks"));
    if lists {
        config.resolution = RESOLUTION;
    }
    config.counters = spec.counters();
    for given in Given::all(spec) {
        match given.name {
            "resolution" => config.resolution = given.number()?,
            "tile" => config.tile = given.number()?,
            "buckets" => config.buckets = given.number()?,
            "slices" => config.slices = Some(given.number()?),
            "corners" => config.corners = given.switch()?,
            "capacity" => config.entries = Some(given.number()?.into()),
            "skip" => config.skip = given.switch()?,
            "storage" => {
                config.storage = given.choice(&[
                    ("llb", Storage::Linked),
                    ("sb", Storage::Contiguous),
                    ("bricks", Storage::Bricks),
                ])?;
            }
            // One word so far: a value is checked, and nothing else is chosen.
            "views" => given.choice(&[("cube", ())])?,
            "addressing" => {
                config.addressing = given
                    .choice(&[("descriptor", Addressing::Descriptor), ("address", Addressing::Address)])?;
            }
            _ => return Err(given.unknown()),
        }
    }
    config.validate()?;
    Ok(config)
}

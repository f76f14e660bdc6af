//! LDC: the layered depth cube with the paper's presets.

use rasray_ldc::{Accept, Builder, Config, Coverage, Depth, LayeredDepthCube, Making, Occupancy, Payload};

use crate::option::Given;
use crate::{Preset, Spec, System, SystemsError};

/// The registry's row.
pub(crate) const SYSTEM: System = System {
    name: "ldc",
    structure: |_| "ldc",
    presets: &[Preset::Robust, Preset::Published],
    occlusion_payload: None,
    camera_views: None,
    options: &OPTIONS,
    requirements: |spec| Ok(LayeredDepthCube::requirements_of(&config(spec)?)),
    kind: |spec| Ok(LayeredDepthCube::kind_of(&config(spec)?)),
    create: |spec, device, geometry, scene| {
        Ok(Box::new(LayeredDepthCube::new(device, config(spec)?, geometry, scene)?))
    },
};

/// Options by their names on the command line.
const OPTIONS: [&str; 18] = [
    "build",
    "layers",
    "resolution",
    "block",
    "levels",
    "occupancy",
    "storage",
    "payload",
    "ids",
    "accept",
    "tolerance",
    "depth",
    "coverage",
    "builder",
    "skip",
    "views",
    "addressing",
    "capacity",
];

/// Cells a side of a view where nothing else is asked for.
const RESOLUTION: u32 = 512;

/// The larger of the two sizes of the paper's table.
const PUBLISHED_RESOLUTION: u32 = 1024;

/// The configuration that a spec stands for.
pub(crate) fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let mut config = match spec.preset() {
        Preset::Robust => Config::robust(RESOLUTION),
        Preset::Published => Config::published(PUBLISHED_RESOLUTION),
    };
    config.counters = spec.counters();
    config.work_budget = spec.work_budget();
    for given in Given::all(spec) {
        match given.name {
            "resolution" => config.resolution = given.number()?,
            "block" => config.block = given.number()?,
            "layers" => config.layers = given.number()?,
            "build" => config.making = given.choice(&[("single", Making::Single), ("peel", Making::Peel)])?,
            "levels" => config.levels = given.number()?,
            "occupancy" => {
                config.occupancy =
                    given.choice(&[("bounds", Occupancy::Bounds), ("slices", Occupancy::Slices)])?;
            }
            "capacity" => config.fragments = Some(given.number()?.into()),
            "tolerance" => config.tolerance = given.share()?,
            "skip" => config.skip = given.switch()?,
            "builder" => {
                config.builder = given.choice(&Builder::ALL.map(|builder| (builder.name(), builder)))?;
            }
            // One word each so far: a value is checked, and nothing else is chosen.
            "storage" => given.choice(&[("sb", ())])?,
            "views" => given.choice(&[("axes", ())])?,
            "ids" => config.ids = given.switch()?,
            "payload" => {
                config.payload =
                    given.choice(&[("index", Payload::Index), ("attributes", Payload::Attributes)])?;
            }
            "depth" => config.depth = given.choice(&[("16", Depth::Bits16), ("32", Depth::Bits32)])?,
            "accept" => {
                config.accept = given.choice(&[
                    ("tolerance", Accept::Tolerance),
                    ("slope", Accept::Slope),
                    ("plane", Accept::Plane),
                ])?;
            }
            "coverage" => {
                config.coverage = given.choice(&[
                    ("exact", Coverage::Exact),
                    ("hardware", Coverage::Hardware),
                    ("conservative", Coverage::Conservative),
                ])?;
            }
            "addressing" => config.addressing = given.addressing()?,
            _ => return Err(given.unknown()),
        }
    }
    config.validate()?;
    Ok(config)
}

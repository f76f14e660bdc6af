//! DIRT: primitive lists with the paper's presets.

use rasray_ads_primitive::{
    Accept, Builder, Centre, Config, Coverage, Depths, March, PrimitiveLists, Stop, Storage, Views,
};

use crate::option::Given;
use crate::{Preset, Spec, System, SystemsError};

/// The registry's row.
pub(crate) const SYSTEM: System = System {
    name: "dirt",
    structure: |_| "ads-primitive",
    presets: &[Preset::Robust, Preset::Published],
    occlusion_payload: None,
    camera_views: None,
    options: &OPTIONS,
    requirements: |spec| Ok(PrimitiveLists::requirements_of(&config(spec, 0)?)),
    kind: |spec| Ok(PrimitiveLists::kind_of(&config(spec, 0)?)),
    create: |spec, device, geometry, scene| {
        let config = config(spec, geometry.triangle_count())?;
        Ok(Box::new(PrimitiveLists::new(device, config, geometry, scene)?))
    },
};

/// Options by their names on the command line.
const OPTIONS: [&str; 19] = [
    "resolution",
    "tile",
    "buckets",
    "slices",
    "storage",
    "corners",
    "coverage",
    "accept",
    "stop",
    "depths",
    "march",
    "skip",
    "pyramid",
    "builder",
    "centre",
    "views",
    "grid",
    "addressing",
    "capacity",
];

/// Pixels a side of a face where lists are asked for and nothing else is.
const RESOLUTION: u32 = 256;

/// Those of the paper's second table.
const PUBLISHED_RESOLUTION: u32 = 512;

/// The configuration that a spec stands for, for a geometry of that many triangles.
pub(crate) fn config(spec: &Spec, triangles: u32) -> Result<Config, SystemsError> {
    let lists = Given::all(spec).any(|given| given.name == "storage" && given.is_not("bricks"));
    let mut config = match spec.preset() {
        Preset::Robust if lists => Config::robust(RESOLUTION),
        Preset::Robust => Config::robust_for(triangles),
        Preset::Published => Config::published(PUBLISHED_RESOLUTION),
    };
    config.counters = spec.counters();
    config.work_budget = spec.work_budget();
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
            "coverage" => {
                config.coverage = given
                    .choice(&[("conservative", Coverage::Conservative), ("hardware", Coverage::Hardware)])?;
            }
            "accept" => config.accept = given.choice(&[("t", Accept::T), ("tile", Accept::Tile)])?,
            "stop" => config.stop = given.choice(&[("best", Stop::Best), ("bucket", Stop::Bucket)])?,
            "depths" => {
                config.depths =
                    given.choice(&[("clipped", Depths::Clipped), ("corners", Depths::Corners)])?;
            }
            "march" => config.march = given.choice(&[("exact", March::Exact), ("jump", March::Jump)])?,
            "pyramid" => config.pyramid = given.switch()?,
            "centre" => {
                config.centre = given.choice(&[("eye", Centre::Eye), ("scene", Centre::Scene)])?;
            }
            "builder" => {
                let words = Builder::ALL.map(|builder| (builder.name(), builder));
                config.builder = Some(given.choice(&words)?);
            }
            "views" => {
                config.views = given.choice(&[Views::Cube, Views::Axes].map(|views| (views.name(), views)))?
            }
            "grid" => config.grid = Some(given.number()?),
            "addressing" => config.addressing = given.addressing()?,
            _ => return Err(given.unknown()),
        }
    }
    config.validate()?;
    Ok(config)
}

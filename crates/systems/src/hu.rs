//! Hu et al.: voxels with axis A-buffers, with the paper's presets; and bricks of triangles in their place.

use rasray_ads_primitive::{Config as BricksConfig, PrimitiveLists, Views};
use rasray_voxel::{Config, Payload, Voxels};

use crate::option::Given;
use crate::{Preset, Spec, System, SystemsError, voxel};

/// Cells a side of a view in the paper.
const PUBLISHED_RESOLUTION: u32 = 1280;

/// The registry's row.
pub(crate) const SYSTEM: System = System {
    name: "hu",
    structure: |spec| if keeps_triangles(spec) { "ads-primitive" } else { "voxel" },
    presets: &[Preset::Robust, Preset::Published],
    occlusion_payload: None,
    camera_views: None,
    options: &voxel::OPTIONS,
    requirements: |spec| {
        Ok(if keeps_triangles(spec) {
            PrimitiveLists::requirements_of(&bricks(spec)?)
        } else {
            Voxels::requirements_of(&config(spec)?)
        })
    },
    kind: |spec| {
        Ok(if keeps_triangles(spec) {
            PrimitiveLists::kind_of(&bricks(spec)?)
        } else {
            Voxels::kind_of(&config(spec)?)
        })
    },
    create: |spec, device, geometry, scene| {
        Ok(if keeps_triangles(spec) {
            Box::new(PrimitiveLists::new(device, bricks(spec)?, geometry, scene)?)
        } else {
            Box::new(Voxels::new(device, config(spec)?, geometry, scene)?)
        })
    },
};

/// Whether bricks of cells along the axes take the place of voxels and views: what is stored are triangles then.
fn keeps_triangles(spec: &Spec) -> bool {
    Given::all(spec).any(|given| given.name == "storage" && !given.is_not("bricks"))
}

/// The configuration that a spec stands for.
pub(crate) fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let preset = match spec.preset() {
        Preset::Robust => Config::robust(voxel::RESOLUTION),
        Preset::Published => voxel::of_the_paper(spec, Config::published_hu(PUBLISHED_RESOLUTION)),
    };
    voxel::config(spec, preset, Payload::Material)
}

/// The same where it keeps triangles.
fn bricks(spec: &Spec) -> Result<BricksConfig, SystemsError> {
    let mut config = BricksConfig { views: Views::Axes, ..BricksConfig::robust(1) };
    config.counters = spec.counters();
    config.work_budget = spec.work_budget();
    for given in Given::all(spec) {
        match given.name {
            "storage" if spec.preset() == Preset::Robust => {}
            "storage" => return Err(given.refused("the paper stores fragments: take the preset robust")),
            "grid" => config.grid = Some(given.number()?),
            "capacity" => config.entries = Some(given.number()?.into()),
            "addressing" => config.addressing = given.addressing()?,
            _ => {
                return Err(given.refused(
                    "with storage bricks triangles are kept, not fragments, and only grid, capacity and addressing are chosen",
                ));
            }
        }
    }
    config.validate()?;
    Ok(config)
}

//! Options of the systems that trace voxels with axis A-buffers.

use rasray_voxel::{Accept, Axes, Builder, Config, Coverage, March, Marking, Payload, Storage};

use crate::option::Given;
use crate::{Spec, SystemsError};

/// Options by their names on the command line.
pub(crate) const OPTIONS: [&str; 16] = [
    "resolution",
    "grid",
    "axes",
    "voxels",
    "march",
    "samples",
    "accept",
    "coverage",
    "builder",
    "storage",
    "payload",
    "ids",
    "page",
    "sort",
    "addressing",
    "capacity",
];

/// Cells a side of a view of the repaired structure where nothing else is asked for.
pub(crate) const RESOLUTION: u32 = 512;

/// Voxels a side of both papers. With another resolution than theirs the first one's rule follows it.
pub(crate) const PUBLISHED_GRID: u32 = 64;

/// A preset with its paper's voxels, where the resolution is the paper's as well.
pub(crate) fn of_the_paper(spec: &Spec, preset: Config) -> Config {
    let given = Given::all(spec).any(|given| given.name == "resolution");
    Config { grid: (!given).then_some(PUBLISHED_GRID), ..preset }
}

/// The configuration that a spec stands for over a preset. `attributes` is the payload of the system's paper.
pub(crate) fn config(spec: &Spec, preset: Config, attributes: Payload) -> Result<Config, SystemsError> {
    let mut config = preset;
    config.counters = spec.counters();
    config.work_budget = spec.work_budget();
    for given in Given::all(spec) {
        match given.name {
            "resolution" => config.resolution = given.number()?,
            "grid" => config.grid = Some(given.number()?),
            "samples" => config.samples = given.number()?,
            "page" => config.page = given.number()?,
            "capacity" => config.fragments = Some(given.number()?.into()),
            "sort" => config.sort = given.switch()?,
            "builder" => {
                config.builder = given.choice(&Builder::ALL.map(|builder| (builder.name(), builder)))?;
            }
            "axes" => {
                config.axes = given.choice(&[
                    ("all", Axes::All),
                    ("voxel", Axes::Voxel),
                    ("triangle", Axes::Triangle),
                ])?;
            }
            "voxels" => {
                config.voxels = Some(
                    given.choice(&[("fragments", Marking::Fragments), ("triangles", Marking::Triangles)])?,
                );
            }
            "march" => {
                config.march = given.choice(&[("samples", March::Samples), ("exact", March::Exact)])?;
            }
            "accept" => {
                config.accept = given.choice(&[("parity", Accept::Parity), ("plane", Accept::Plane)])?;
            }
            "ids" => config.ids = given.switch()?,
            "payload" => {
                config.payload = given.choice(&[("index", Payload::Index), ("attributes", attributes)])?;
            }
            "coverage" => {
                config.coverage = given.choice(&[
                    ("exact", Coverage::Exact),
                    ("hardware", Coverage::Hardware),
                    ("conservative", Coverage::Conservative),
                ])?;
            }
            "storage" => {
                config.storage = given.choice(&Storage::ALL.map(|storage| (storage.name(), storage)))?;
            }
            "addressing" => config.addressing = given.addressing()?,
            _ => return Err(given.unknown()),
        }
    }
    config.validate()?;
    Ok(config)
}

//! MMRT: the A-buffer with the paper's presets.

use rasray_abuffer::{Accept, Addressing, Config, Coverage, March, Payload};

use crate::{Preset, Spec, SystemsError};

/// Options by their names on the command line.
pub(crate) static OPTIONS: [&str; 14] = [
    "resolution",
    "buckets",
    "storage",
    "payload",
    "march",
    "samples",
    "accept",
    "thickness",
    "coverage",
    "sort",
    "skip",
    "views",
    "addressing",
    "capacity",
];

/// Cells a side where nothing else is asked for.
const RESOLUTION: u32 = 512;

/// The configuration that a spec stands for.
pub(crate) fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let mut config = match spec.preset() {
        Preset::Robust => Config::robust(RESOLUTION),
        Preset::Published => Config::published(RESOLUTION),
    };
    config.counters = spec.counters();
    for (option, value) in spec.options() {
        let refuse = |expected| SystemsError::Value {
            system: spec.system().name,
            option: option.clone(),
            value: value.clone(),
            expected,
        };
        let number = || value.parse::<u32>().map_err(|_| refuse("a whole number is expected"));
        let switch = || match value.as_str() {
            "on" => Ok(true),
            "off" => Ok(false),
            _ => Err(refuse("on or off")),
        };
        match option.as_str() {
            "resolution" => config.resolution = number()?,
            "buckets" => config.buckets = number()?,
            "samples" => config.samples = number()?,
            "capacity" => config.fragments = Some(number()?.into()),
            "thickness" => {
                config.thickness = value.parse().map_err(|_| refuse("a length in metres is expected"))?;
            }
            "sort" => config.sort = switch()?,
            "skip" => config.skip = switch()?,
            "storage" if value == "dllb" => {}
            "storage" => return Err(refuse("the storage is dllb")),
            "views" if value == "cube" => {}
            "views" => return Err(refuse("the views are cube")),
            "payload" => {
                config.payload = match value.as_str() {
                    "index" => Payload::Index,
                    "attributes" => Payload::Attributes,
                    _ => return Err(refuse("index or attributes")),
                };
            }
            "march" => {
                config.march = match value.as_str() {
                    "samples" => March::Samples,
                    "exact" => March::Exact,
                    _ => return Err(refuse("samples or exact")),
                };
            }
            "accept" => {
                config.accept = match value.as_str() {
                    "interval" => Accept::Interval,
                    "thickness" => Accept::Thickness,
                    "plane" => Accept::Plane,
                    _ => return Err(refuse("interval, thickness or plane")),
                };
            }
            "coverage" => {
                config.coverage = match value.as_str() {
                    "exact" => Coverage::Exact,
                    "hardware" => Coverage::Hardware,
                    _ => return Err(refuse("exact or hardware")),
                };
            }
            "addressing" => {
                config.addressing = match value.as_str() {
                    "descriptor" => Addressing::Descriptor,
                    "address" => Addressing::Address,
                    _ => return Err(refuse("descriptor or address")),
                };
            }
            _ => {
                return Err(SystemsError::UnknownOption {
                    system: spec.system().name,
                    option: option.clone(),
                });
            }
        }
    }
    config.validate()?;
    Ok(config)
}

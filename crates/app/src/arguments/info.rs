//! Options of `rasray info`.

use super::integrator::integrator_parser;
use super::shared::DeviceArguments;
use super::structure::{StructureArguments, preset_parser, system_request_parser};
use super::values::Quantity;
use crate::error::AppError;
use clap::{ArgGroup, Args};
use rasray_experiment::{INTEGRATORS, IntegratorRow, SystemConfig, SystemRequest};
use rasray_systems::Preset;
use std::ffi::OsString;

const AFTER_HELP: &str = "\
Examples:
  rasray info
  rasray info scene.glb --integrator ao
  rasray info scene.glb --json
  rasray info scene.glb --passes --system mmrt --storage dll
  rasray info scene.glb --statistics --system selective

Without a scene: the devices, what the one in use offers, and which way each structure takes on it.
With a scene: what is in it and what moves it, its cameras and the view where none is named, and what of it an image can show.
With --passes: what the structure's build, its traces and its surface lookup record on this device, pass by pass.
With --statistics: what the lists of its cells hold once it is built: layers per cell, slots that pages waste.";

/// Id of the group of options about a structure, one of which must be given.
const OF_STRUCTURE: &str = "of structure";

/// Options of `rasray info`.
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP, group = ArgGroup::new(OF_STRUCTURE).args(["passes", "statistics"]))]
pub struct InfoArguments {
    /// A file (.gltf .glb .obj .ply), numbered files ('a.####.ply'), or a built-in scene with parameters
    #[arg(value_name = "SCENE")]
    pub scene: Option<OsString>,
    /// With numbered files: frames per second [default: 25]
    #[arg(long, value_name = "N", value_parser = Quantity::FRAMES_PER_SECOND.parser::<f64>(), requires = "scene")]
    pub fps: Option<f64>,
    /// With a scene: time of its animation, seconds [default: at rest]
    #[arg(long, value_name = "SECONDS", value_parser = Quantity::SECONDS.parser::<f64>(), allow_hyphen_values = true, requires = "scene")]
    pub time: Option<f64>,
    /// With --time: the clip that moves the scene, by name or by position from 0 [default: all that do not
    /// move the same thing]
    #[arg(long, value_name = "NAME", requires = "time")]
    pub clip: Option<String>,
    /// With a scene: the integrator whose needs are shown
    #[arg(long, value_parser = integrator_parser(), default_value = INTEGRATORS[0].name)]
    pub integrator: &'static IntegratorRow,
    /// With a scene: the passes of a structure and how many dispatches and draws each records
    #[arg(long, requires = "scene")]
    pub passes: bool,
    /// With a scene: contents of the lists of a structure's cells
    #[arg(long, requires = "scene")]
    pub statistics: bool,
    /// With --passes or --statistics: the structure
    #[arg(long, value_parser = system_request_parser(), default_value = SystemRequest::AUTOMATIC, requires = OF_STRUCTURE)]
    pub system: SystemRequest,
    /// With --passes or --statistics: its fidelity to its paper
    #[arg(long, value_parser = preset_parser(), default_value = Preset::Robust.name(), requires = OF_STRUCTURE)]
    pub preset: Preset,
    /// Output as JSON
    #[arg(long)]
    pub json: bool,
    /// With --passes or --statistics: options of the structure.
    #[command(flatten)]
    pub structure: StructureArguments,
    /// Device that does the work.
    #[command(flatten)]
    pub device: DeviceArguments,
}

impl InfoArguments {
    /// Returns the system whose passes or lists are wanted.
    ///
    /// # Errors
    /// The system does not have a preset or an option, or does not accept a value; or options of structures
    /// are given although no structure is shown.
    pub fn system(&self) -> Result<Option<SystemConfig>, AppError> {
        if self.passes || self.statistics {
            return Ok(Some(self.system.config(self.preset, &self.structure.0)?));
        }
        match self.structure.0.iter().next() {
            Some((option, _)) => Err(AppError::usage(
                format!("--{option} is an option of a structure, and no structure is asked for"),
                "add --passes or --statistics, or leave it out",
            )),
            None => Ok(None),
        }
    }
}

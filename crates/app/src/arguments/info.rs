//! Options of `rasray info`.

use super::shared::{DeviceArguments, IntegratorName};
use clap::Args;
use std::ffi::OsString;

const AFTER_HELP: &str = "\
Examples:
  rasray info
  rasray info scene.glb --integrator ao
  rasray info scene.glb --json

Without a scene: the devices, what the one in use offers, and which way each structure takes on it.
With a scene: what is in it, its cameras and the view where none is named, and what of it an image can show.";

/// Options of `rasray info`.
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub struct InfoArguments {
    /// A file (.gltf .glb .obj .ply) or a built-in scene with parameters
    #[arg(value_name = "SCENE")]
    pub scene: Option<OsString>,
    /// With a scene: the integrator whose needs are shown
    #[arg(long, value_enum, default_value_t = IntegratorName::Path)]
    pub integrator: IntegratorName,
    /// The same as JSON
    #[arg(long)]
    pub json: bool,
    /// Where the work is done.
    #[command(flatten)]
    pub device: DeviceArguments,
}

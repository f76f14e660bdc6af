//! Options of `rasray view`.

use super::shared::WorkArguments;
use super::structure::{preset_parser, system_request_parser};
use super::tone::ToneArguments;
use clap::Args;
use rasray_experiment::SystemRequest;
use rasray_systems::Preset;
use std::ffi::OsString;
use std::path::PathBuf;

const AFTER_HELP: &str = "\
Examples:
  rasray view cornell
  rasray view scene.glb --size 1280x720 --integrator ao
  rasray view walk.glb --system mmrt --preset published --time 0.5

Left drag turns around the scene, right drag looks around, the middle button and Shift with a left drag move
sideways, the wheel goes nearer; W A S D and E Q fly. R puts the camera back, F shows everything, 1 3 7 show
the front, the right side and the top. Ctrl with the wheel or a drag zooms and moves the picture, Ctrl with a
click picks a point. Space plays, P saves the picture, C copies the command line that makes it again, H hides
the panel, Ctrl+Q closes. Everything else is on the panel, with all keys. A file that is dropped on the window
is opened. The picture refines while nothing moves, up to --spp samples.

The window needs the cargo feature viewer, which takes some minutes more to build:
  cargo run --release --package rasray-app --features viewer -- view cornell
`tools/rasray view cornell` builds it so.";

/// Options of `rasray view`.
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP, mut_arg("size", |argument| argument.help("Pixels").default_value("640x360")),
          mut_arg("spp", |argument| argument.help("Samples per pixel, 1 to 1048576").default_value("256")))]
pub struct ViewerArguments {
    /// A file (.gltf .glb .obj .ply) or a built-in scene with parameters
    #[arg(value_name = "SCENE")]
    pub scene: OsString,
    /// Acceleration structure of all rays
    #[arg(long, value_parser = system_request_parser(), default_value = SystemRequest::AUTOMATIC)]
    pub system: SystemRequest,
    /// Fidelity of the system to its paper
    #[arg(long, value_parser = preset_parser(), default_value = Preset::Robust.name())]
    pub preset: Preset,
    /// File that pictures are saved as, .png; a run of # is a number [default: as SCENE is named]
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Colours, as shown and saved.
    #[command(flatten)]
    pub tone: ToneArguments,
    /// The image, the camera, the scene, the structure and the device.
    #[command(flatten)]
    pub work: WorkArguments,
}

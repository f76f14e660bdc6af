//! Options of `rasray render`.

use super::options::choice;
use super::shared::WorkArguments;
use super::structure::{preset_parser, refresh_parser, system_request_parser};
use super::tone::ToneArguments;
use super::values::{self, Quantity};
use crate::error::AppError;
use crate::output::ImageFormat;
use clap::Args;
use clap::builder::TypedValueParser;
use rasray_experiment::{
    Adaptive, Aov, AovSelection, Frame, Primary, Refresh, Shard, SystemConfig, SystemRequest,
};
use rasray_scene::builtin::{Picture, picture};
use rasray_systems::Preset;
use std::ffi::OsString;
use std::ops::RangeInclusive;
use std::path::PathBuf;

const AFTER_HELP: &str = "\
Examples:
  rasray render cornell --output cornell.png
  rasray render scene.glb --size 1280x720 --spp 256 --bounces 5 --output scene.exr
  rasray render scene.glb --integrator ao --ao-distance 2 --output ao.exr --aov depth,normal,primitive
  rasray render scene.obj --eye 0,1.6,4 --target 0,1,0 --fov 60 --environment 1,1,1 --output view.png
  rasray render cornell --system mmrt --preset published --resolution 512 --report r.json --output p.png
  rasray render cornell --output - --format png | display
  rasray render walk.glb --frames 0-49 --output 'walk.####.png' --report walk.jsonl --resume
  rasray render scene.glb --spp 256 --shard 1/4 --output part.1.exr    (then: rasray merge)
  rasray render 'simulated/cloth.####.ply' --frames 0-99 --fps 30 --output 'cloth.####.png'
  rasray render cloth-ball --time 1.2 --output cloth.png

PNG holds 8-bit sRGB: colours times 2^exposure, clamped to 0 to 1, then the sRGB curve, so that other programs
reproduce it; with --tone agx or aces a curve in place of the clamp. EXR holds linear 32-bit floats: R, G, B, and with --aov
the channels that it names; where nothing was hit they are 0, and indices 4294967295. Files are written next to their place and renamed, so a file there is always whole; of a link it is
the file that the link leads to. The camera that was used is printed as options that put one there.

SIGINT (Ctrl-C), SIGTERM or SIGHUP: the samples done so far are written, exit code 130; where none is, the command
ends within two seconds and writes nothing. A second one stops at once and writes nothing. Of --frames and
of --shard only whole images are written; run again with --resume.";

const FRAMES: &str = "Frames and shares";
const IMAGE: &str = "Image";

/// Advice for options that do not go together.
const LEAVE_ONE: &str = "leave one of the two out";

/// Default number of samples of the pilot.
const LEAST_SAMPLES: u32 = 16;

/// Options of `rasray render`.
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP, mut_arg("exposure", |argument| argument.requires("output")),
          mut_arg("tone", |argument| argument.requires("output")))]
pub struct RenderArguments {
    /// A file (.gltf .glb .obj .ply), numbered files ('a.####.ply'), or a built-in scene with parameters
    #[arg(value_name = "SCENE")]
    pub scene: OsString,
    /// Acceleration structure of all rays
    #[arg(long, value_parser = system_request_parser(), default_value = SystemRequest::AUTOMATIC)]
    pub system: SystemRequest,
    /// Fidelity of the system to its paper
    #[arg(long, value_parser = preset_parser(), default_value = Preset::Robust.name())]
    pub preset: Preset,
    /// Image to write: .png or .exr; - is standard output
    #[arg(long, short, value_name = "FILE", required_unless_present = "report")]
    pub output: Option<PathBuf>,
    /// File format of the image [default: by the name of --output]
    #[arg(long, value_enum, requires = "output")]
    pub format: Option<ImageFormat>,
    /// Images in addition to the colours, kept in the .exr
    #[arg(long, value_parser = aov_parser(), value_delimiter = ',', requires = "output")]
    pub aov: Vec<Aov>,
    /// Colours of a .png.
    #[command(flatten)]
    pub tone: ToneArguments,
    /// JSON with times, bytes and counts; - is standard output
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// Builds that are timed after the first, for the medians of a report, 1 to 10000 [default: none]
    #[arg(long, value_name = "N", value_parser = values::whole(1, 10_000))]
    pub repetitions: Option<u32>,
    /// Frames of an animation, numbers as in 0-99: one image each, at number / --fps seconds. In the names of
    /// --output and --report a run of # is the number; a report .jsonl without one takes a row per frame
    #[arg(long, value_name = "FIRST-LAST", value_parser = values::frames, requires = "output", conflicts_with = "time",
          help_heading = FRAMES)]
    pub frames: Option<RangeInclusive<u32>>,
    /// Parts of the structure that each frame builds
    #[arg(long, value_parser = refresh_parser(), default_value = Refresh::All.name(), requires = "frames", conflicts_with = "time",
          help_heading = FRAMES)]
    pub refresh: Refresh,
    /// Leave whole images alone that this command would make again, by the key that they carry: it goes on
    /// where it was stopped, and replaces what was made of another scene or with other options
    #[arg(long, requires = "output", help_heading = FRAMES)]
    pub resume: bool,
    /// One of N shares of the work, I from 1 to N: of --frames each Nth; else of the samples, as an .exr for
    /// rasray merge
    #[arg(long, value_name = "I/N", value_parser = values::shard, help_heading = FRAMES)]
    pub shard: Option<Shard>,
    /// The image, the camera, the scene, the structure and the device.
    #[command(flatten)]
    pub work: WorkArguments,
    /// Take what noise is left out of the picture, with the library Open Image Denoise where it is installed
    #[arg(long, requires = "output", help_heading = IMAGE)]
    pub denoise: bool,
    /// More samples where there is more noise: each pixel gets as many, up to --spp, as the first samples of
    /// the pixels around it need for this standard error, as a share of their radiance, such as 0.02. The
    /// image is as unbiased as without
    #[arg(long, value_name = "SHARE", value_parser = Quantity::NOISE.parser::<f64>(), help_heading = IMAGE)]
    pub adaptive: Option<f64>,
    /// Samples that every pixel gets and that say how many more are needed, 2 to 1048576 [default: 16, at
    /// most --spp]
    #[arg(long, value_name = "N", value_parser = values::whole(2, 1_048_576), requires = "adaptive", help_heading = IMAGE)]
    pub least_samples: Option<u32>,
}

/// Makes a parser that reads the name of an image in addition to the colours.
fn aov_parser() -> impl TypedValueParser<Value = Aov> {
    choice(Aov::ALL, |aov| (aov.name(), aov.doc()))
}

impl RenderArguments {
    /// Makes the configuration of the system with its options.
    ///
    /// # Errors
    /// The system does not have a preset or an option, or does not accept a value.
    pub fn system(&self) -> Result<SystemConfig, AppError> {
        Ok(self.system.config(self.preset, &self.work.structure.0)?)
    }

    /// Returns the frame that was asked for. If no option describes it and the scene's own camera is used,
    /// the frame is the one that suits a built-in scene.
    ///
    /// # Errors
    /// An option belongs to an integrator that was not chosen, or does not go with adaptive samples.
    pub fn frame(&self) -> Result<Frame, AppError> {
        let defaults = self.system.frame_defaults(self.preset);
        let frame = self.work.frame(defaults, self.adaptive.is_none())?;
        let (given, view) = (&self.work.frame, &self.work.view);
        let suits = self.scene.to_str().filter(|_| view.eye.is_none()).and_then(picture);
        let frame = match suits {
            Some(Picture { size: [width, height], samples }) if given.size.is_none() => {
                Frame { width, height, spp: given.spp.unwrap_or(samples), ..frame }
            }
            _ => frame,
        };
        Ok(Frame { adaptive: self.adaptive(&frame)?, ..frame })
    }

    /// Returns the images wanted in addition to the colours of a frame.
    ///
    /// # Errors
    /// The frame, or the file that is made of it, does not have an image.
    pub fn aovs(&self, frame: &Frame) -> Result<AovSelection, AppError> {
        let aovs = AovSelection::from_iter(self.aov.iter().copied());
        if self.denoise && self.shard.is_some() && self.frames.is_none() {
            return Err(AppError::usage(
                "--denoise is of a whole picture, and a --shard has some samples of it",
                "make the share with --aov albedo,normal in place of --denoise, which rasray merge takes then",
            ));
        }
        for aov in aovs.iter() {
            let name = aov.name();
            let of_paths = matches!(aov, Aov::Direct | Aov::Indirect);
            let (why, fix) = if of_paths && frame.integrator.row().option("bounces").is_none() {
                let own = frame.integrator.name();
                (
                    format!("--aov {name} is of paths, and --integrator {own} has none"),
                    "write --integrator path",
                )
            } else if of_paths && self.denoise {
                (
                    format!("--aov {name} is of the picture with its noise, and --denoise takes that out"),
                    LEAVE_ONE,
                )
            } else if of_paths && self.adaptive.is_some() {
                let why = "shares samples by the noise of the picture, not by that of a part of its light";
                (
                    format!("--aov {name} is of as many samples as the picture, and --adaptive {why}"),
                    LEAVE_ONE,
                )
            } else if aov.is_of_samples() && self.shard.is_some() && self.frames.is_none() {
                let why = "is of a whole image, and a --shard has samples of its own";
                (format!("--aov {name} {why}"), LEAVE_ONE)
            } else if aov == Aov::Motion && self.frames.is_none() {
                (
                    format!("--aov {name} leads to the frame before, and there are no frames"),
                    "ask for --frames",
                )
            } else {
                continue;
            };
            return Err(AppError::usage(why, fix));
        }
        Ok(aovs)
    }

    /// Returns the rule for the number of samples of each pixel; `None` if each pixel gets all.
    fn adaptive(&self, frame: &Frame) -> Result<Option<Adaptive>, AppError> {
        let Some(threshold) = self.adaptive else { return Ok(None) };
        let refused = |why: String, fix: &str| Err(AppError::usage(why, fix));
        if frame.primary == Primary::Raster {
            return refused(
                "--primary raster draws camera rays of all pixels, and --adaptive asks for those of some"
                    .to_owned(),
                LEAVE_ONE,
            );
        }
        if self.shard.is_some() && self.frames.is_none() {
            return refused(
                "--adaptive shares samples by the first of all, which a --shard of them does not have"
                    .to_owned(),
                "leave one of the two out, or make shares of --frames",
            );
        }
        match self.least_samples {
            Some(least) if least > frame.spp => refused(
                format!("--least-samples {least} are more than the {} of --spp", frame.spp),
                "ask for fewer, or for more --spp",
            ),
            least => Ok(Some(Adaptive { threshold, least: least.unwrap_or(LEAST_SAMPLES).min(frame.spp) })),
        }
    }
}

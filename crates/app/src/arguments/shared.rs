//! Groups of options that several commands take.

use super::integrator::{IntegratorArguments, integrator_parser};
use super::structure::{
    StructureArguments, back_faces_parser, occluder_parser, primary_parser, sampler_parser,
};
use super::values::{self, Quantity, Size, Switch};
use crate::error::AppError;
use clap::{ArgAction, Args, ValueEnum};
use glam::DVec3;
use rasray_experiment::{
    AovSelection, DeviceChoice, Frame, FrameDefaults, IntegratorRow, OccluderKind, Primary, Sampler,
};
use rasray_scene::needs::{Needs, Workload};
use rasray_scene::{BackFaces, Environment, Scene, SceneError};
use rasray_scene_files::{LoadOptions, load_environment};
use rasray_scene_source::{ChosenCamera, LoadError, LoadedScene, placed_view};
use std::path::Path;

/// Default size of an image.
const DEFAULT_SIZE: Size = Size { width: 640, height: 360 };

/// Default number of samples per pixel.
const DEFAULT_SAMPLES: u32 = 16;

/// Amount of messages in addition to results and errors.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct TalkArguments {
    /// Say nothing but errors and what was asked for
    #[arg(long, short, global = true, conflicts_with = "verbose", help_heading = "Messages")]
    pub quiet: bool,
    /// Print every number of a run, not the short summary
    #[arg(long, short, global = true, help_heading = "Messages")]
    pub verbose: bool,
    /// Print what most people need
    #[arg(long, short, global = true, action = ArgAction::HelpShort, help_heading = "Messages")]
    pub help: Option<bool>,
    /// Print everything: methods of papers, tuning, diagnostics
    #[arg(long, global = true, action = ArgAction::HelpLong, help_heading = "Messages")]
    pub help_all: Option<bool>,
}

/// The image and its integrator.
#[derive(Debug, Args)]
#[command(next_help_heading = "Image")]
pub struct FrameArguments {
    /// Integrator [default: path; with --preset published the frame of its paper: integrator, primary,
    /// occluder]
    #[arg(long, value_parser = integrator_parser())]
    pub integrator: Option<&'static IntegratorRow>,
    /// Pixels [default: 640x360; pictures of cornell: 256x256]
    #[arg(long, value_name = "WxH", value_parser = values::size)]
    pub size: Option<Size>,
    /// Samples per pixel, 1 to 1048576 [default: 16; pictures of cornell: 32]
    #[arg(long, value_name = "N", value_parser = values::whole(1, 1_048_576))]
    pub spp: Option<u32>,
    /// Options of integrators.
    #[command(flatten)]
    pub options: IntegratorArguments,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u32,
    /// Source of random numbers
    #[arg(long, value_parser = sampler_parser(), default_value = Sampler::Sobol.name())]
    pub sampler: Sampler,
    /// Method of first hits of images [default: trace; raster with a system after a paper]
    #[arg(long, value_parser = primary_parser())]
    pub primary: Option<Primary>,
    /// Occluder of shadow rays, of images [default: structure; or the paper's]
    #[arg(long, value_parser = occluder_parser())]
    pub occluder: Option<OccluderKind>,
    /// Texels along a side of a shadow map, with --occluder shadow-maps, 16 to 16384 [default: 1024]
    #[arg(long, value_name = "N", value_parser = values::whole(OccluderKind::RESOLUTIONS[0], OccluderKind::RESOLUTIONS[1]))]
    pub shadow_resolution: Option<u32>,
    /// Points on each emitting triangle with a cube of maps each, with --occluder shadow-maps [default: 0,
    /// rays are traced]
    #[arg(long, value_name = "N", value_parser = values::whole(0, OccluderKind::MOST_POINTS))]
    pub shadow_points: Option<u32>,
    /// Rays that pass the backs of single-sided surfaces, as glTF has them (doubleSided: false)
    #[arg(long, value_parser = back_faces_parser(), default_value = BackFaces::Camera.name())]
    pub back_faces: BackFaces,
}

impl FrameArguments {
    /// Returns the frame that was asked for; it is that of `defaults` if no option describes it and no
    /// integrator is named.
    ///
    /// # Errors
    /// An option belongs to an integrator or an occluder that was not chosen.
    fn frame(&self, defaults: FrameDefaults) -> Result<Frame, AppError> {
        let defaults = match self.integrator {
            Some(integrator) => FrameDefaults { integrator, ..FrameDefaults::default() },
            None => defaults,
        };
        let integrator = self.options.over(&defaults)?;
        let Size { width, height } = self.size.unwrap_or(DEFAULT_SIZE);
        let spp = self.spp.unwrap_or(DEFAULT_SAMPLES);
        let occluder = self.occluder(defaults.occluder)?;
        let primary = self.primary.unwrap_or(defaults.primary);
        let adaptive = None;
        let Self { seed, sampler, back_faces, .. } = *self;
        Ok(Frame { integrator, width, height, spp, adaptive, seed, sampler, primary, occluder, back_faces })
    }

    fn occluder(&self, default: OccluderKind) -> Result<OccluderKind, AppError> {
        if let OccluderKind::ShadowMaps { resolution, points } = self.occluder.unwrap_or(default) {
            let resolution = self.shadow_resolution.unwrap_or(resolution);
            return Ok(OccluderKind::ShadowMaps { resolution, points: self.shadow_points.unwrap_or(points) });
        }
        let given = [("resolution", self.shadow_resolution), ("points", self.shadow_points)];
        match given.iter().find_map(|(option, value)| Some((option, (*value)?))) {
            None => Ok(OccluderKind::Structure),
            Some((option, value)) => Err(AppError::usage(
                format!("--shadow-{option} {value} is of shadow maps, and shadow rays are traced"),
                format!("write --occluder shadow-maps, or leave --shadow-{option} out"),
            )),
        }
    }
}

/// From where the scene is seen.
#[derive(Clone, Debug, Default, Args)]
#[command(
    next_help_heading = "Camera (default: the scene's first, or one before the scene, within it if it is a room)"
)]
pub struct ViewArguments {
    /// A camera of the scene, by name or by position from 0
    #[arg(long, value_name = "NAME", conflicts_with_all = ["eye", "target", "fov"])]
    pub camera: Option<String>,
    /// Position of the eye, metres from -1e18 to 1e18
    #[arg(long, value_name = "X,Y,Z", value_parser = values::point, allow_hyphen_values = true, requires = "target")]
    pub eye: Option<[f64; 3]>,
    /// Point to look at, metres from -1e18 to 1e18
    #[arg(long, value_name = "X,Y,Z", value_parser = values::point, allow_hyphen_values = true, requires = "eye")]
    pub target: Option<[f64; 3]>,
    /// Full vertical angle of view, with --eye and --target [default: 45]
    #[arg(long, value_name = "DEGREES", value_parser = Quantity::ANGLE_OF_VIEW.parser::<f64>(), requires = "eye")]
    pub fov: Option<f64>,
    /// Diameter of the lens's opening, metres: what is not in focus is blurred. A lens of 50 mm at f/1.8 has
    /// 0.05 / 1.8 [default: 0, a pinhole]
    #[arg(long, value_name = "METRES", value_parser = Quantity::LENGTH.parser::<f64>())]
    pub aperture: Option<f64>,
    /// With an aperture: distance of the plane in focus, metres along the view, above 0 [default: that of
    /// --target]
    #[arg(long, value_name = "METRES", value_parser = Quantity::DISTANCE.parser::<f64>(), requires = "aperture")]
    pub focus: Option<f64>,
}

impl ViewArguments {
    /// Chooses the camera that was asked for; otherwise that of [`LoadedScene::default_view`].
    ///
    /// # Errors
    /// The scene lacks the camera, the eye is at its own target, or the camera cannot have the lens.
    pub fn choose(&self, loaded: &mut LoadedScene) -> Result<ChosenCamera, LoadError> {
        let chosen = match (self.eye, self.target, &self.camera) {
            (Some(eye), Some(target), _) => placed_view(eye, target, self.fov),
            (_, _, Some(name)) => loaded.named_view(name),
            _ => loaded.default_view(),
        }?;
        let Some(aperture) = self.aperture else { return Ok(chosen) };
        let target = self.eye.zip(self.target).map(|(eye, target)| DVec3::from(eye).distance(target.into()));
        chosen.with_lens(aperture, self.focus.or(target))
    }
}

/// Parts of a scene that are handled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum NeedsName {
    /// Only what scene and integrator let an image show
    Observed,
    /// Everything, to prove that the picture does not change
    All,
}

/// Options of reading a scene.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Scene")]
pub struct SceneArguments {
    /// Radiance from outside: a latitude-longitude map (.hdr), or one colour, black too [default: the
    /// scene's; where nothing lights the scene, a neutral sky with a soft key light. Surfaces that emit light
    /// it from a mean radiance of 0.05 over all surfaces on: lamps in a room do, marks that glow on an object
    /// do not]
    #[arg(long, value_name = "FILE.hdr|R,G,B")]
    pub environment: Option<String>,
    /// Let alpha cut holes and blend; off makes every surface opaque
    #[arg(long, value_enum, default_value_t = Switch::On)]
    pub alpha: Switch,
    /// Show the scene at this time of its animation, seconds from -1e9 to 1e9; before the first and after the
    /// last key it stands still. Of numbered files, the last that has begun is shown [default: at rest, as
    /// the file places everything]
    #[arg(long, value_name = "SECONDS", value_parser = Quantity::SECONDS.parser::<f64>(), allow_hyphen_values = true)]
    pub time: Option<f64>,
    /// With a time: the clip that moves the scene, by name or by position from 0 [default: all that do not
    /// move the same thing]
    #[arg(long, value_name = "NAME")]
    pub clip: Option<String>,
    /// Frames per second: number n of --frames, or of a scene in numbered files, is shown at n / this
    /// [default: 25]
    #[arg(long, value_name = "N", value_parser = Quantity::FRAMES_PER_SECOND.parser::<f64>())]
    pub fps: Option<f64>,
    /// Parts of the scene that are uploaded, compiled in and stored
    #[arg(long, value_enum, default_value_t = NeedsName::Observed)]
    pub needs: NeedsName,
}

impl SceneArguments {
    /// Returns the frames per second, given or by default.
    pub fn frames_per_second(&self) -> f64 {
        self.fps.unwrap_or(LoadOptions::FPS)
    }

    /// Returns the radiance from outside that was asked for: a map, or one colour.
    ///
    /// # Errors
    /// A colour is negative, a file cannot be read, or pixels are not valid radiance.
    pub fn environment(&self) -> Result<Option<Environment>, AppError> {
        let Some(value) = self.environment.as_deref() else { return Ok(None) };
        let path = Path::new(value);
        if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("hdr")) {
            return Ok(Some(load_environment(path).map_err(|error| unreadable_map(path, &error))?));
        }
        let color = values::three(value).ok_or_else(|| {
            AppError::usage(
                format!("--environment {value} is neither a .hdr file nor a colour"),
                "write --environment sky.hdr, or three linear values such as --environment 0.5,0.7,1",
            )
        })?;
        let color = color.map(|channel| channel as f32);
        if !color.iter().all(|channel| channel.is_finite() && *channel >= 0.0) {
            return Err(AppError::usage(
                format!("--environment {value} has a value that is negative, too large or no number"),
                "radiance is at least 0 and at most 3e38",
            ));
        }
        Ok(Some(Environment::Constant(color)))
    }

    /// Returns the parts of the scene that the work needs.
    pub fn needs(&self, scene: &Scene, workload: Workload, aovs: AovSelection) -> Needs {
        match self.needs {
            NeedsName::Observed => aovs.needs(scene, workload),
            NeedsName::All => Needs::all(),
        }
    }
}

/// Makes the error of a map that cannot be read.
fn unreadable_map(path: &Path, error: &SceneError) -> AppError {
    let fix = "give a Radiance .hdr file of at most 2^27 pixels";
    match error {
        SceneError::Read { source, .. } => AppError::input(path, source, fix),
        SceneError::Syntax { reason, .. } => AppError::input(path, reason, fix),
        // These messages name the file themselves.
        other => AppError::usage(other.to_string(), fix),
    }
}

/// Options of every command that shows a scene: groups of options, in the order of its help.
#[derive(Debug, Args)]
pub struct WorkArguments {
    /// The image and its integrator; where rays are compared the size also shapes those of the camera.
    #[command(flatten)]
    pub frame: FrameArguments,
    /// From where.
    #[command(flatten)]
    pub view: ViewArguments,
    /// Reading of the scene.
    #[command(flatten)]
    pub reading: SceneArguments,
    /// Options of structures.
    #[command(flatten)]
    pub structure: StructureArguments,
    /// Device that does the work.
    #[command(flatten)]
    pub device: DeviceArguments,
}

impl WorkArguments {
    /// Returns the frame that was asked for; it is that of `defaults` if no option describes it and no
    /// integrator is named. First hits are drawn if the camera is a pinhole and all pixels are rendered;
    /// otherwise they are traced by default.
    ///
    /// # Errors
    /// An option belongs to an integrator or an occluder that was not chosen.
    pub fn frame(&self, mut defaults: FrameDefaults, of_all_pixels: bool) -> Result<Frame, AppError> {
        if !of_all_pixels || self.view.aperture.is_some_and(|aperture| aperture > 0.0) {
            defaults.primary = Primary::Trace;
        }
        self.frame.frame(defaults)
    }
}

/// Device that does the work.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Device")]
pub struct DeviceArguments {
    /// Position or part of the name, as `rasray info` lists them
    #[arg(long, value_name = "DEVICE")]
    pub device: Option<String>,
    /// Run with validation layers; any message of theirs is an error
    #[arg(long)]
    pub validation: bool,
}

impl DeviceArguments {
    /// Returns the choice of the device in the form of the backend.
    pub fn choice(&self) -> DeviceChoice {
        DeviceChoice { device: self.device.clone(), validation: self.validation }
    }
}

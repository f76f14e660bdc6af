//! Command `rasray view` with its window.

use crate::arguments::values::Switch;
use crate::arguments::{NeedsName, SceneArguments, ViewArguments, ViewerArguments};
use crate::commands::steps::{keep_inputs, prepare};
use crate::error::AppError;
use crate::hints;
use crate::interrupt::Interrupt;
use crate::output::{self, Destination, ImageFormat};
use crate::progress::during;
use crate::terminal;
use rasray_experiment::{Frame, SystemConfig, open_device};
use rasray_metrics::Tone;
use rasray_scene::default_view;
use rasray_scene_source::{ChosenCamera, LoadError, LoadedScene};
use rasray_viewer::{
    End, Engine, Failure, Opened, Opening, SavedPicture, SceneSource, Session, Settings, Shown, Standpoint,
    ViewerError, Viewing, camera_names, check_display, run,
};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Opens a window for a scene, until the window is closed.
///
/// # Errors
/// As for a render; also if there is no display.
pub(crate) fn view(given: &ViewerArguments, interrupt: &Interrupt) -> Result<(), AppError> {
    check_display()?;
    let opener = Opener {
        frame: given.work.frame(given.system.frame_defaults(given.preset), true)?,
        system: given.system.config(given.preset, &given.work.structure.0)?,
        reading: given.work.reading.clone(),
        view: given.work.view.clone(),
        output: given.output.clone(),
        tone: given.tone.tone(),
        device: given.work.device.device.clone(),
    };
    let Opened { opening, source } = during("scene", "reading", || opener.open(&given.scene))?;
    let device = during("device", "opening", || open_device(&given.work.device.choice()))?;
    let validation = given.work.device.validation;
    let (settings, later) = (opening.settings.clone(), opener.for_other_scenes());
    let end = run(Viewing {
        device: device.name().to_owned(),
        validation,
        engine: Box::new(move || Engine::new(device, validation, source, settings)),
        session: Session::new(opening, explain),
        open: Arc::new(move |scene: &OsStr| later.open(scene).map_err(|error| failure(&error))),
        stop: &|| interrupt.requested(),
        save: &mut |saved| save(saved, interrupt).map_err(|error| error.to_string()),
    })?;
    match end {
        End::Closed => Ok(()),
        End::Stopped => Err(AppError::interrupted("the window was closed by a signal", "")),
    }
}

/// Describes an error in the words of the command.
fn failure(error: &AppError) -> Failure {
    Failure { message: error.to_string(), help: error.help().into_owned() }
}

/// Describes as [`failure`] an error that a window shows while it goes on.
fn explain(error: &ViewerError) -> Failure {
    let message = match error {
        ViewerError::Experiment(error) => hints::message(error),
        ViewerError::Denoise(error) => hints::message_of_denoiser(error),
        other => other.to_string(),
    };
    Failure { message, help: hints::help_of_viewer(error).into_owned() }
}

/// Opener of scenes by the options of a command line.
struct Opener {
    frame: Frame,
    system: SystemConfig,
    reading: SceneArguments,
    view: ViewArguments,
    output: Option<PathBuf>,
    tone: Tone,
    device: Option<String>,
}

impl Opener {
    /// Makes the opener for scenes that the command line did not name, to which its cameras and times do not
    /// apply.
    fn for_other_scenes(self) -> Self {
        let reading = SceneArguments { time: None, clip: None, ..self.reading };
        Self { reading, view: ViewArguments::default(), ..self }
    }

    /// Reads a scene, and returns the state that its session begins with.
    fn open(&self, scene: &OsStr) -> Result<Opened, AppError> {
        let output = self.output.clone().unwrap_or_else(|| default_output(scene));
        if ImageFormat::of(&output)? != ImageFormat::Png {
            return Err(AppError::input(&output, "the window saves 8-bit pictures", "name a .png"));
        }
        keep_inputs("--output", Some(&Destination::check(&output)?), scene)?;
        let mut loaded = prepare(scene, &self.reading, None)?;
        let chosen = self.check_view(&mut loaded)?;
        let is_moving = loaded.moves();
        let system = match is_moving {
            // During play a moment is shown with one sample per pixel.
            true => {
                let rays = Frame { spp: 1, ..self.frame.clone() }.rays();
                self.system.clone().rebuilt_for(rays, loaded.triangles)
            }
            false => self.system.clone(),
        };
        let is_default = chosen.index.is_none() && self.view.eye.is_none();
        let default_camera = match is_default && self.reading.time.is_none() {
            true => chosen.camera,
            false => default_view::default_camera(&loaded.scene),
        };
        let settings = Settings {
            scene: 0,
            standpoint: Standpoint::AsGiven,
            seconds: self.reading.time,
            system,
            frame: self.frame.clone(),
            shown: Shown::Picture,
            denoised: false,
            moving: false,
        };
        let opening = Opening {
            scene: scene.to_owned(),
            camera_words: camera_words(&self.view),
            camera_is_default: is_default,
            cameras: camera_names(&loaded),
            default_camera,
            time_words: words("--clip", self.reading.clip.clone()),
            other_words: self.other_words(),
            settings,
            tone: self.tone,
            duration: if is_moving { loaded.scene.animation.duration.into() } else { 0.0 },
            bounds: default_view::bounds(&loaded.scene).unwrap_or_default(),
            output,
        };
        let choice = self.view.clone();
        let source = SceneSource {
            loaded,
            clip: self.reading.clip.clone(),
            needs_all: self.reading.needs == NeedsName::All,
            camera: Box::new(move |loaded: &mut LoadedScene| choice.choose(loaded)),
        };
        Ok(Opened { opening, source })
    }

    /// Refuses a camera, a time or a clip that the scene does not have before the scene is shown, and prints
    /// the warnings about the first view.
    fn check_view(&self, loaded: &mut LoadedScene) -> Result<ChosenCamera, LoadError> {
        let SceneArguments { time, clip, .. } = &self.reading;
        if time.is_none() && clip.is_none() {
            let chosen = self.view.choose(loaded)?;
            terminal::warn_of_scene(&loaded.scene, loaded.triangles);
            return Ok(chosen);
        }
        let mut shown = loaded.clone();
        shown.show(time.unwrap_or(0.0), clip.as_deref())?;
        if time.is_some() {
            shown.relight();
        }
        let chosen = self.view.choose(&mut shown)?;
        let seen = if time.is_some() { &shown } else { loaded };
        terminal::warn_of_scene(&seen.scene, seen.triangles);
        Ok(chosen)
    }

    /// Returns the words of a render for options that the window does not change.
    fn other_words(&self) -> Vec<String> {
        let mut all = words("--environment", self.reading.environment.clone());
        all.extend(words("--alpha", (self.reading.alpha == Switch::Off).then(|| "off".to_owned())));
        all.extend(words("--needs", (self.reading.needs == NeedsName::All).then(|| "all".to_owned())));
        all.extend(words("--device", self.device.clone()));
        all
    }
}

/// Writes a picture and prints how to make it again.
fn save(saved: &SavedPicture<'_>, interrupt: &Interrupt) -> Result<(), AppError> {
    let png = output::encode_shown(saved.pixels, saved.size, saved.tone, saved.denoised)?;
    Destination::check(saved.place)?.write(&png, interrupt)?;
    if let Some(scale) = &saved.scale {
        terminal::note(scale);
    }
    if let Some(line) = saved.command_line {
        let what = if saved.is_finished { "it is made by" } else { "when refined to its end it is made by" };
        terminal::note(&format!("{what}: {line}"));
    }
    Ok(())
}

/// Returns the name of the scene with a number.
fn default_output(scene: &OsStr) -> PathBuf {
    let name = Path::new(scene).file_stem().unwrap_or_default().to_string_lossy();
    // Parameters of a built-in scene are left out of the file's name.
    let name = name.split(':').next().filter(|name| !name.is_empty()).unwrap_or("scene");
    PathBuf::from(format!("{name}.####.png"))
}

/// Returns an option with its value, if it was given.
fn words(option: &str, value: Option<String>) -> Vec<String> {
    value.into_iter().flat_map(|value| [option.to_owned(), value]).collect()
}

fn camera_words(view: &ViewArguments) -> Vec<String> {
    let point = |point: [f64; 3]| point.map(|value| value.to_string()).join(",");
    let mut all = words("--camera", view.camera.clone());
    all.extend(words("--eye", view.eye.map(point)));
    all.extend(words("--target", view.target.map(point)));
    all.extend(words("--fov", view.fov.map(|fov| fov.to_string())));
    all.extend(words("--aperture", view.aperture.map(|aperture| aperture.to_string())));
    all.extend(words("--focus", view.focus.map(|focus| focus.to_string())));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_denoise::DenoiseError;

    #[test]
    fn a_missing_denoiser_is_told_as_the_command_tells_it() {
        let reason = || "no such file".to_owned();
        let missing = DenoiseError::Missing { reason: reason() };
        let expected = Failure {
            message: hints::message_of_denoiser(&missing),
            help: hints::help_of_denoiser(&missing).to_owned(),
        };
        assert_eq!(explain(&missing.into()), expected);
        assert!(expected.message.starts_with("--denoise: ") && expected.message.ends_with(&reason()));
        assert!(expected.help.contains("pip install pyoidn"), "{}", expected.help);
    }

    #[test]
    fn pictures_are_named_after_the_scene() {
        let of = |scene: &str| default_output(scene.as_ref());
        assert_eq!(of("spheres:10k"), PathBuf::from("spheres.####.png"));
        assert_eq!(of("far/walk.glb"), PathBuf::from("walk.####.png"));
    }
}

//! Steps that several commands have in common.

use crate::arguments::values::Switch;
use crate::arguments::{DeviceArguments, SceneArguments, ViewArguments};
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::Destination;
use crate::progress::{ProgressLine, during};
use crate::terminal;
use rasray_experiment::{Backend, ExperimentError, OpenBackend, Progress, texels};
use rasray_scene::needs::Needs;
use rasray_scene_files::LoadOptions;
use rasray_scene_files::sequence::{Sequence, is_pattern};
use rasray_scene_source::{ChosenCamera, LoadError, LoadedScene, load_with};
use std::ffi::OsStr;
use std::ops::ControlFlow;
use std::path::Path;

/// Checks the place of an output that was asked for.
pub(super) fn destination(path: Option<&Path>) -> Result<Option<Destination>, AppError> {
    path.map(Destination::check).transpose()
}

/// Refuses an output of `option` that would overwrite the scene, or a file of it.
pub(super) fn keep_inputs(option: &str, output: Option<&Destination>, scene: &OsStr) -> Result<(), AppError> {
    let scene = Path::new(scene);
    let Some(output) = output else { return Ok(()) };
    if scene.is_file() && output.is(scene) {
        return Err(AppError::usage(
            format!("{option} names the scene file"),
            "name another file, such as result.png or report.json",
        ));
    }
    if is_pattern(scene)
        && Sequence::find(scene, &LoadOptions::default())
            .map_err(LoadError::from)?
            .files()
            .iter()
            .any(|file| output.is(file))
    {
        return Err(AppError::usage(
            format!("{option} names a file of the scene"),
            "name another file, such as result.png or report.json",
        ));
    }
    Ok(())
}

/// Opens the wanted device.
pub(super) fn open_device(
    open: &mut OpenBackend<'_>,
    given: &DeviceArguments,
) -> Result<Box<dyn Backend>, AppError> {
    during("device", "opening", || Ok(open(&given.choice())?))
}

/// Side that poses a scene which is shown at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Posing {
    /// Device, for pictures. The scene stays at rest.
    Device,
    /// Host, for comparisons with a reference that reads the scene.
    Host,
}

/// Times at which a scene is shown.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shown {
    /// First time, seconds.
    pub(super) seconds: f64,
    pub(super) posing: Posing,
    /// All times at which the command shows the scene, if it shows frames, over all shares.
    pub(super) times: Vec<f64>,
}

/// Reads a scene as the command line asks, shown at a time or at rest, and chooses the camera; warns of data
/// that was left out.
pub(super) fn read_scene(
    name: &OsStr,
    reading: &SceneArguments,
    shown: Option<&Shown>,
    view: &ViewArguments,
) -> Result<(LoadedScene, ChosenCamera), AppError> {
    if shown.is_none() && reading.clip.is_some() {
        return Err(AppError::usage(
            "--clip says what moves the scene, and nothing says when",
            "say --time SECONDS, or to `rasray render` --frames FIRST-LAST",
        ));
    }
    let mut loaded = during("scene", "reading", || prepare(name, reading, shown))?;
    let chosen = during("scene", "looking for a view", || view.choose(&mut loaded))?;
    terminal::warn_of_scene(&loaded.scene, loaded.triangles);
    Ok((loaded, chosen))
}

/// Loads the scene that `name` stands for; `fps` belongs to numbered files.
///
/// # Errors
/// Frames per second are given for a scene without frames.
pub(super) fn load_scene(name: &OsStr, fps: Option<f64>, has_frames: bool) -> Result<LoadedScene, AppError> {
    if fps.is_some() && !has_frames && !is_pattern(Path::new(name)) {
        return Err(AppError::usage(
            "--fps is of frames, and there are none",
            "leave it out, ask `rasray render` for --frames, or name numbered files such as 'cloth.####.ply'",
        ));
    }
    let fps = fps.unwrap_or(LoadOptions::FPS);
    Ok(load_with(name, &LoadOptions { fps, ..LoadOptions::default() })?)
}

/// Loads a scene as the command line asks: with its environment, its alpha masks, and light.
pub(super) fn prepare(
    name: &OsStr,
    reading: &SceneArguments,
    shown: Option<&Shown>,
) -> Result<LoadedScene, AppError> {
    // A faulty environment is quick to refuse, so it is read before the scene.
    let environment = reading.environment()?;
    // A time that does not come from --time is that of a frame.
    let mut loaded = load_scene(name, reading.fps, shown.is_some() && reading.time.is_none())?;
    if reading.alpha == Switch::Off {
        loaded.close_holes();
    }
    if shown.is_some() && !loaded.moves() {
        let (option, asks) = match reading.time {
            Some(_) => ("--time", "asks for a time of it"),
            None => ("--frames", "asks for frames of it"),
        };
        return Err(AppError::usage(
            format!("{option} {asks}, but the scene {} has no clips: nothing moves it", loaded.scene.name),
            format!("leave {option} out; `rasray info SCENE` says what moves"),
        ));
    }
    let clip = reading.clip.as_deref();
    match shown {
        Some(Shown { seconds, posing: Posing::Device, .. }) => loaded.show(*seconds, clip)?,
        Some(Shown { seconds, posing: Posing::Host, .. }) => loaded.pose(*seconds, clip)?,
        None => {}
    }
    match shown.map(|shown| &shown.times) {
        Some(times) if !times.is_empty() => loaded.light_frames(environment, clip, times.iter().copied())?,
        _ => loaded.light(environment),
    }
    Ok(loaded)
}

/// Makes images smaller if the device cannot hold all of them, and warns of it.
pub(super) fn fit_images(
    loaded: &mut LoadedScene,
    needs: &Needs,
    backend: &dyn Backend,
) -> Result<(), AppError> {
    let fitted = during("scene", "fitting images", || texels::fit(loaded, needs, &backend.texel_capacity()))?;
    if let Some(text) = fitted {
        terminal::warn(&format!("{}: {text} (smaller-images)", loaded.scene.name));
    }
    Ok(())
}

/// Does `work` with a progress line; a signal asks it to end early. `is_kept` tells from which progress on
/// there is a finished part that an early end keeps: before that, a signal does not wait for it.
pub(super) fn with_progress<T>(
    interrupt: &Interrupt,
    is_kept: impl Fn(&Progress<'_>) -> bool,
    work: impl FnOnce(&mut dyn FnMut(Progress<'_>) -> ControlFlow<()>) -> Result<T, ExperimentError>,
) -> Result<T, AppError> {
    let mut line = ProgressLine::new();
    let result = work(&mut |progress| {
        line.show(progress);
        if is_kept(&progress) {
            interrupt.keep();
        }
        if interrupt.requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    interrupt.keep();
    line.finish();
    Ok(result?)
}

/// Stops before anything is begun, if a signal asked for it.
pub(super) fn stop_if_requested(interrupt: &Interrupt) -> Result<(), AppError> {
    if interrupt.requested() {
        return Err(AppError::interrupted("stopped before the first sample; nothing was written", ""));
    }
    Ok(())
}

//! `rasray view`.

#[cfg(not(feature = "viewer"))]
pub(crate) use without_window::view;

#[cfg(feature = "viewer")]
pub(crate) use with_window::view;

#[cfg(not(feature = "viewer"))]
mod without_window {
    use crate::arguments::ViewerArguments;
    use crate::error::AppError;
    use crate::interrupt::Interrupt;

    /// Says how to get the window.
    ///
    /// # Errors
    /// Always.
    pub(crate) fn view(given: &ViewerArguments, _interrupt: &Interrupt) -> Result<(), AppError> {
        Err(AppError::usage(
            "this rasray was built without its window",
            format!(
                "build it with: cargo run --release --package rasray-app --features viewer -- view {}",
                given.scene.to_string_lossy()
            ),
        ))
    }
}

#[cfg(feature = "viewer")]
mod with_window {
    use crate::arguments::values::Switch;
    use crate::arguments::{NeedsName, SceneArguments, ViewArguments, ViewerArguments};
    use crate::commands::steps::{keep_inputs, prepare};
    use crate::error::AppError;
    use crate::interrupt::Interrupt;
    use crate::output::{self, Destination, ImageFormat};
    use crate::progress::during;
    use crate::terminal;
    use rasray_experiment::{Frame, open_device};
    use rasray_scene::default_view;
    use rasray_scene_source::{Chosen, LoadError, LoadedScene};
    use rasray_viewer::{
        End, Engine, Opening, SavedPicture, SceneSource, Session, Settings, Shown, Standpoint, Viewing,
        check_display, run,
    };
    use std::path::{Path, PathBuf};

    /// Opens a window for a scene, until it is closed.
    ///
    /// # Errors
    /// As of a render, and where there is no display.
    pub(crate) fn view(given: &ViewerArguments, interrupt: &Interrupt) -> Result<(), AppError> {
        check_display()?;
        let frame = given.work.frame(given.system.frame_defaults(given.preset), true)?;
        let system = given.system.config(given.preset, &given.work.structure.0)?;
        let output = given.output.clone().unwrap_or_else(|| default_output(&given.scene));
        if ImageFormat::of(&output)? != ImageFormat::Png {
            return Err(AppError::input(&output, "the window saves 8-bit pictures", "name a .png"));
        }
        keep_inputs("--output", Some(&Destination::check(&output)?), &given.scene)?;
        let mut loaded = during("scene", "reading", || prepare(&given.scene, &given.work.reading, None))?;
        let chosen = check_view(given, &mut loaded)?;

        let is_moving = !loaded.scene.animation.clips.is_empty() || loaded.scene.animation.deformer.is_some();
        let system = match is_moving {
            // A moment of play is shown with a sample per pixel.
            true => system.rebuilt_for(Frame { spp: 1, ..frame.clone() }.rays(), loaded.triangles),
            false => system,
        };
        let seconds = given.work.reading.time;
        let settings = Settings {
            standpoint: Standpoint::AsGiven,
            seconds,
            system,
            frame,
            shown: Shown::Picture,
            moving: false,
        };
        let animation = &loaded.scene.animation;
        let session = Session::new(Opening {
            scene: given.scene.clone(),
            camera_words: camera_words(&given.work.view),
            camera_is_default: chosen.index.is_none() && given.work.view.eye.is_none(),
            time_words: words("--clip", given.work.reading.clip.clone()),
            other_words: other_words(given),
            settings: settings.clone(),
            exposure: given.exposure,
            duration: if is_moving { animation.duration.into() } else { 0.0 },
            bounds: default_view::bounds(&loaded.scene).unwrap_or_default(),
            output,
        });
        let device = during("device", "opening", || open_device(&given.work.device.choice()))?;
        let (choice, validation) = (given.work.view.clone(), given.work.device.validation);
        let source = SceneSource {
            loaded,
            clip: given.work.reading.clip.clone(),
            needs_all: given.work.reading.needs == NeedsName::All,
            camera: Box::new(move |loaded: &mut LoadedScene| choice.choose(loaded)),
        };
        let end = run(Viewing {
            device: device.name().to_owned(),
            validation,
            engine: Box::new(move || Engine::new(device, validation, source, settings)),
            session,
            stop: &|| interrupt.requested(),
            save: &mut |saved| save(saved, interrupt).map_err(|error| error.to_string()),
        })?;
        match end {
            End::Closed => Ok(()),
            End::Stopped => Err(AppError::interrupted("the window was closed by a signal", "")),
        }
    }

    /// Refuses a camera, a time or a clip that the scene does not have before a window is opened, and says what there is to
    /// remark on what is shown first.
    fn check_view(given: &ViewerArguments, loaded: &mut LoadedScene) -> Result<Chosen, LoadError> {
        let SceneArguments { time, clip, .. } = &given.work.reading;
        if time.is_none() && clip.is_none() {
            let chosen = given.work.view.choose(loaded)?;
            terminal::warn_of_scene(&loaded.scene, loaded.triangles);
            return Ok(chosen);
        }
        let mut shown = loaded.clone();
        shown.show(time.unwrap_or(0.0), clip.as_deref())?;
        if time.is_some() {
            shown.relight();
        }
        let chosen = given.work.view.choose(&mut shown)?;
        let seen = if time.is_some() { &shown } else { loaded };
        terminal::warn_of_scene(&seen.scene, seen.triangles);
        Ok(chosen)
    }

    /// Writes a picture and says how to make it again.
    fn save(saved: &SavedPicture<'_>, interrupt: &Interrupt) -> Result<(), AppError> {
        let png = output::encode_picture(saved.pixels, saved.size)?;
        Destination::check(saved.place)?.write(&png, interrupt)?;
        if let Some(scale) = &saved.scale {
            terminal::note(scale);
        }
        if let Some(line) = saved.command_line {
            let what =
                if saved.is_finished { "it is made by" } else { "when refined to its end it is made by" };
            terminal::note(&format!("{what}: {line}"));
        }
        Ok(())
    }

    /// The name of the scene and a number.
    fn default_output(scene: &std::ffi::OsStr) -> PathBuf {
        let name = Path::new(scene).file_stem().unwrap_or_default().to_string_lossy();
        // Parameters of a built-in scene are no part of a file's name.
        let name = name.split(':').next().filter(|name| !name.is_empty()).unwrap_or("scene");
        PathBuf::from(format!("{name}.####.png"))
    }

    /// An option with its value, where it was given.
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

    /// What a render is told as well, and the window does not change.
    fn other_words(given: &ViewerArguments) -> Vec<String> {
        let mut all = words("--environment", given.work.reading.environment.clone());
        all.extend(words("--alpha", (given.work.reading.alpha == Switch::Off).then(|| "off".to_owned())));
        all.extend(words("--needs", (given.work.reading.needs == NeedsName::All).then(|| "all".to_owned())));
        all.extend(words("--device", given.work.device.device.clone()));
        all
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        #[test]
        fn pictures_are_named_after_the_scene() {
            let of = |scene: &str| default_output(scene.as_ref());
            assert_eq!(of("spheres:10k"), PathBuf::from("spheres.####.png"));
            assert_eq!(of("far/walk.glb"), PathBuf::from("walk.####.png"));
        }
    }
}

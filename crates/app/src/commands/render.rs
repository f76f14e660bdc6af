//! `rasray render`.

use super::steps::{
    destination, fit_images, keep_inputs, open_device, read_scene, stop_if_requested, with_progress,
};
use crate::arguments::RenderArguments;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::{self, Destination, ImageFormat, Metadata};
use crate::terminal::{self, Talk};
use crate::version::origin;
use rasray_experiment::{
    AovSelection, Backend, Chosen, Frame, LoadedScene, OpenBackend, Progress, RenderJob, RenderOutput,
    SystemConfig, check_run,
};
use rasray_report::{Report, json_shown, table};
use std::io::IsTerminal;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

/// Renders a scene, or frames of it, and writes what was asked for; `line` is the command as it was typed.
///
/// # Errors
/// Everything that can be refused without a device is refused before a device is opened.
pub(crate) fn render(
    given: &RenderArguments,
    line: &str,
    open: &mut OpenBackend<'_>,
    interrupt: &Interrupt,
) -> Result<(), AppError> {
    let frame = given.frame.frame()?;
    let aovs = given.aovs();
    let system = given.system()?.serving(frame.workload());
    let numbers = given.frames.clone();
    // Of frames this refuses what is wrong with the first.
    let targets = Targets::of(given, aovs, numbers.as_ref().map(|numbers| *numbers.start()))?;
    let time = numbers.as_ref().map_or(given.reading.time, |numbers| {
        Some(seconds(*numbers.start(), given.reading.frames_per_second()))
    });
    let (loaded, chosen) = read_scene(&given.scene, &given.reading, time, &given.view)?;
    system.shortcoming(frame.workload()).iter().for_each(|text| terminal::warn(text));

    let backend = open_device(open, &given.device)?;
    stop_if_requested(interrupt)?;
    let mut pictures = Pictures { given, line, interrupt, frame, aovs, system, loaded, chosen, backend };
    match numbers {
        None => pictures.render(&targets, true),
        Some(numbers) => pictures.render_frames(numbers),
    }
}

/// Where a picture and its report go.
struct Targets {
    image: Option<(Destination, ImageFormat)>,
    report: Option<Destination>,
}

impl Targets {
    /// As the command line says, with the number of a frame in the names where there is one.
    fn of(given: &RenderArguments, aovs: AovSelection, number: Option<u32>) -> Result<Self, AppError> {
        let named = |option: &str, path: Option<&Path>| -> Result<Option<PathBuf>, AppError> {
            let Some(path) = path else { return Ok(None) };
            let Some(number) = number else { return Ok(Some(path.to_owned())) };
            let path = numbered(path, number).ok_or_else(|| {
                AppError::usage(
                    format!("{option} names one file, and --frames makes several"),
                    format!("write a run of # where the number goes: {option} 'frame.####.png'"),
                )
            })?;
            Ok(Some(path))
        };
        let image = image_target(given, named("--output", given.output.as_deref())?.as_deref(), aovs)?;
        let report = destination(named("--report", given.report.as_deref())?.as_deref())?;
        if let (Some((place, _)), Some(report)) = (&image, &report)
            && place.same_as(report)
        {
            return Err(AppError::usage("--output and --report name the same file", "name two files"));
        }
        keep_inputs("--output", image.as_ref().map(|(place, _)| place), &given.scene)?;
        keep_inputs("--report", report.as_ref(), &given.scene)?;
        Ok(Self { image, report })
    }
}

/// When a frame is shown.
fn seconds(number: u32, fps: f64) -> f64 {
    f64::from(number) / fps
}

/// The path with a number in place of the last run of # in its file name, with as many digits or more; absent where it
/// has none.
fn numbered(path: &Path, number: u32) -> Option<PathBuf> {
    let name = path.file_name()?.to_str()?;
    let end = name.rfind('#')? + 1;
    let begin = name[..end].trim_end_matches('#').len();
    let width = end - begin;
    Some(path.with_file_name(format!("{}{number:0width$}{}", &name[..begin], &name[end..])))
}

/// What the pictures of a command have in common.
struct Pictures<'a> {
    given: &'a RenderArguments,
    line: &'a str,
    interrupt: &'a Interrupt,
    frame: Frame,
    aovs: AovSelection,
    system: SystemConfig,
    loaded: LoadedScene,
    chosen: Chosen,
    backend: Box<dyn Backend>,
}

impl Pictures<'_> {
    /// Renders one frame after the other. A camera of the scene moves with it, any other one stays.
    fn render_frames(&mut self, numbers: RangeInclusive<u32>) -> Result<(), AppError> {
        let (mut written, mut skipped) = (0, 0);
        for number in numbers.clone() {
            let targets = Targets::of(self.given, self.aovs, Some(number))?;
            let is_there = |(place, _): &(Destination, ImageFormat)| place.named().is_file();
            if self.given.skip_existing && targets.image.as_ref().is_some_and(is_there) {
                skipped += 1;
                continue;
            }
            let reading = &self.given.reading;
            let said = self.loaded.scene.animation.deformer_warnings.clone();
            self.loaded.pose(seconds(number, reading.frames_per_second()), reading.clip.as_deref())?;
            terminal::warn_of_frame(&self.loaded.scene, &said);
            if let Some(camera) = self.chosen.index.and_then(|index| self.loaded.scene.cameras.get(index)) {
                self.chosen.camera = camera.clone();
            }
            self.render(&targets, false).map_err(|error| {
                error.about(&format!("frame {number}, of {} to {}", numbers.start(), numbers.end()))
            })?;
            written += 1;
        }
        if skipped > 0 {
            terminal::note(&format!("{written} frames were rendered, {skipped} were there already"));
        }
        Ok(())
    }

    /// Renders the scene as it is and writes what was asked for. `keeps_part`: a signal keeps the samples done so far.
    fn render(&mut self, targets: &Targets, keeps_part: bool) -> Result<(), AppError> {
        let Self { given, line, interrupt, frame, aovs, .. } = *self;
        let chosen = &self.chosen;
        let system = self.system.clone().seen_by(&chosen.camera, frame.width, frame.height);
        let needs = given.reading.needs(&self.loaded.scene, frame.workload());
        fit_images(&mut self.loaded, &needs, self.backend.as_ref())?;
        self.loaded.count_not_uploaded(&chosen.camera, &needs);
        let job = RenderJob {
            scene: &self.loaded.scene,
            camera: chosen.camera.clone(),
            system: system.clone(),
            frame,
            aovs,
            needs,
            repetitions: given.repetitions.unwrap_or(0),
        };
        // A sample takes several waves; an early end keeps whole ones.
        let is_kept = |progress: &Progress<'_>| {
            keeps_part
                && progress.total > 0
                && progress.done.saturating_mul(frame.spp.into()) >= progress.total
        };
        let backend = &mut self.backend;
        let output = with_progress(interrupt, is_kept, |progress| backend.render(&job, progress))?;
        if output.samples_done == 0 {
            return Err(AppError::interrupted(
                "stopped before the first sample was whole; nothing was written",
                "",
            ));
        }
        if output.samples_done < frame.spp && !keeps_part {
            return Err(AppError::interrupted(
                "stopped before the image was whole; it was not written",
                "run again with --skip-existing for the frames that are left",
            ));
        }

        let run = output.run(&system, &frame);
        let whole = check_run(&run);
        let report = Report::new(origin(line), self.backend.device(), self.loaded.record(), vec![run])
            .seen_from(chosen.record());
        if let Some(place) = &targets.report {
            place.write(json_shown(&report.to_json()).as_bytes(), interrupt)?;
        }
        whole?;
        output.check_images(aovs)?;
        if let Some((place, format)) = &targets.image {
            let metadata = Metadata {
                scene: self.loaded.scene.name.clone(),
                system: system.system.name.to_owned(),
                preset: system.preset.name().to_owned(),
                integrator: frame.integrator.name().to_owned(),
                spp: frame.spp,
                samples: output.samples_done,
                seed: frame.seed,
            };
            let exposure = given.exposure.unwrap_or(0.0);
            write_image(place, *format, &output, &metadata, exposure, interrupt)?;
            output::hint(&output, *format, exposure).iter().for_each(|text| terminal::note(text));
        }
        let places = targets.image.iter().map(|(place, _)| place).chain(&targets.report);
        let takes_stdout = places.into_iter().any(Destination::is_stdout);
        terminal::summarize(
            &table(&report, Some(&chosen.described()), terminal::says(Talk::Verbose)),
            takes_stdout,
        )?;
        if output.samples_done < frame.spp {
            let written = targets.image.as_ref().map_or_else(
                || "no image was asked for".to_owned(),
                |(place, _)| format!("the image in {} is valid and holds them", named(place)),
            );
            return Err(AppError::interrupted(
                format!(
                    "stopped after {} of {} samples per pixel; {written}",
                    output.samples_done, frame.spp
                ),
                "run again for the whole image, or with this many --spp for the same one",
            ));
        }
        Ok(())
    }
}

/// Where and how the image is written; refuses images that the format cannot hold.
fn image_target(
    given: &RenderArguments,
    path: Option<&Path>,
    aovs: AovSelection,
) -> Result<Option<(Destination, ImageFormat)>, AppError> {
    let Some(path) = path else { return Ok(None) };
    let to_stdout = path == Path::new("-");
    let format = match given.format {
        Some(format) => format,
        None if to_stdout => {
            return Err(AppError::usage(
                "--output - is standard output, which has no name that says how to write the image",
                "say --format png or --format exr",
            ));
        }
        None => ImageFormat::of(path)?,
    };
    if to_stdout && std::io::stdout().is_terminal() {
        return Err(AppError::usage(
            "--output - would write an image to a terminal",
            "send standard output to a file or to a program that shows images",
        ));
    }
    if format == ImageFormat::Png && aovs != AovSelection::default() {
        return Err(AppError::input(
            path,
            "a PNG cannot hold what --aov asks for",
            "write an .exr, or leave --aov out",
        ));
    }
    if format == ImageFormat::Exr && given.exposure.is_some() {
        return Err(AppError::input(
            path,
            "an EXR holds linear values, which --exposure does not change",
            "leave --exposure out, or write a .png",
        ));
    }
    Ok(Some((Destination::check(path)?, format)))
}

/// A place in words.
fn named(place: &Destination) -> String {
    if place.is_stdout() { "standard output".to_owned() } else { place.named().display().to_string() }
}

fn write_image(
    place: &Destination,
    format: ImageFormat,
    output: &RenderOutput,
    metadata: &Metadata,
    exposure: f32,
    interrupt: &Interrupt,
) -> Result<(), AppError> {
    let non_finite = output.non_finite_pixels();
    if non_finite > 0 {
        terminal::warn(&format!(
            "{non_finite} pixels are not finite numbers; please report the scene (non-finite)"
        ));
    }
    let encoded = match format {
        ImageFormat::Png => output::encode_png(output, exposure),
        ImageFormat::Exr => output::encode_exr(output, metadata),
    };
    let bytes = encoded.map_err(|error| {
        AppError::refused(
            format!("{}: the image could not be encoded: {error}", named(place)),
            "nothing was written; choose the other format",
        )
    })?;
    place.write(&bytes, interrupt)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_run_of_hashes_is_the_number() {
        let shown = |path: &str, number| numbered(Path::new(path), number);
        assert_eq!(shown("out/a.####.png", 7), Some(PathBuf::from("out/a.0007.png")));
        assert_eq!(shown("#1.##.exr", 123), Some(PathBuf::from("#1.123.exr")));
        assert_eq!(shown("#", 5), Some(PathBuf::from("5")));
        assert_eq!(shown("out#/a.png", 7), None, "folders have no number");
    }
}

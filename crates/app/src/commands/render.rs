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
use rasray_experiment::{AovSelection, OpenBackend, Progress, RenderJob, RenderOutput, check_run};
use rasray_report::{Report, json_shown, table};
use std::io::IsTerminal;
use std::path::Path;

/// Renders a scene and writes what was asked for; `line` is the command as it was typed.
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
    let image = image_target(given, aovs)?;
    let report_target = destination(given.report.as_deref())?;
    if let (Some((place, _)), Some(report)) = (&image, &report_target)
        && place.same_as(report)
    {
        return Err(AppError::usage("--output and --report name the same file", "name two files"));
    }
    keep_inputs("--output", image.as_ref().map(|(place, _)| place), &given.scene)?;
    keep_inputs("--report", report_target.as_ref(), &given.scene)?;

    let (mut loaded, chosen) = read_scene(&given.scene, &given.reading, &given.view)?;
    let system = system.seen_by(&chosen.camera, frame.width, frame.height);
    system.shortcoming(frame.workload()).iter().for_each(|text| terminal::warn(text));

    let mut backend = open_device(open, &given.device)?;
    stop_if_requested(interrupt)?;
    let needs = given.reading.needs(&loaded.scene, frame.workload());
    fit_images(&mut loaded, &needs, backend.as_ref())?;
    loaded.count_not_uploaded(&chosen.camera, &needs);
    let job = RenderJob {
        scene: &loaded.scene,
        camera: chosen.camera.clone(),
        system: system.clone(),
        frame,
        aovs,
        needs,
        repetitions: given.repetitions.unwrap_or(0),
    };
    // A sample takes several waves; an early end keeps whole ones.
    let is_kept = |progress: &Progress<'_>| {
        progress.total > 0 && progress.done.saturating_mul(frame.spp.into()) >= progress.total
    };
    let output = with_progress(interrupt, is_kept, |progress| backend.render(&job, progress))?;
    if output.samples_done == 0 {
        return Err(AppError::interrupted(
            "stopped before the first sample was whole; nothing was written",
            "",
        ));
    }

    let run = output.run(&system, &frame);
    let whole = check_run(&run);
    let report =
        Report::new(origin(line), backend.device(), loaded.record(), vec![run]).seen_from(chosen.record());
    if let Some(place) = &report_target {
        place.write(json_shown(&report.to_json()).as_bytes(), interrupt)?;
    }
    whole?;
    output.check_images(aovs)?;
    if let Some((place, format)) = &image {
        let metadata = Metadata {
            scene: loaded.scene.name.clone(),
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
    let takes_stdout = image.iter().map(|(place, _)| place).chain(&report_target).any(Destination::is_stdout);
    terminal::summarize(
        &table(&report, Some(&chosen.described()), terminal::says(Talk::Verbose)),
        takes_stdout,
    )?;
    if output.samples_done < frame.spp {
        let written = image.map_or_else(
            || "no image was asked for".to_owned(),
            |(place, _)| format!("the image in {} is valid and holds them", named(&place)),
        );
        return Err(AppError::interrupted(
            format!("stopped after {} of {} samples per pixel; {written}", output.samples_done, frame.spp),
            "run again for the whole image, or with this many --spp for the same one",
        ));
    }
    Ok(())
}

/// Where and how the image is written; refuses images that the format cannot hold.
fn image_target(
    given: &RenderArguments,
    aovs: AovSelection,
) -> Result<Option<(Destination, ImageFormat)>, AppError> {
    let Some(path) = given.output.as_deref() else { return Ok(None) };
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

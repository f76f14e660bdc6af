//! Destinations of a picture and its report.

use super::steps::{destination, keep_inputs};
use crate::arguments::{RenderArguments, ToneArguments};
use crate::error::AppError;
use crate::output::{Destination, ImageFormat, ImageState, Rows, image_key, key_of_report, standing};
use rasray_experiment::{AovSelection, Shard};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// Destinations of a picture and its report.
pub(super) struct Targets {
    pub(super) image: Option<(Destination, ImageFormat)>,
    pub(super) report: Option<Destination>,
}

impl Targets {
    /// Makes the destinations of the command line, with the number of a frame in the names if there is one.
    pub(super) fn of(
        given: &RenderArguments,
        aovs: AovSelection,
        number: Option<u32>,
    ) -> Result<Self, AppError> {
        let named = |option, path: Option<&Path>, otherwise: &str| -> Result<Option<PathBuf>, AppError> {
            let Some(path) = path else { return Ok(None) };
            let Some(number) = number else { return Ok(Some(path.to_owned())) };
            let path = numbered(path, number).ok_or_else(|| {
                AppError::usage(
                    format!("{option} names one file, and --frames makes several"),
                    format!("write a run of # where the number goes: {option} 'frame.####.{otherwise}"),
                )
            })?;
            Ok(Some(path))
        };
        let image =
            image_target(given, named("--output", given.output.as_deref(), "png'")?.as_deref(), aovs)?;
        let report = given.report.as_deref().filter(|path| number.is_none() || !takes_rows(path));
        let report = named("--report", report, "json', or name a .jsonl, which takes a row per frame")?;
        let report = destination(report.as_deref())?;
        if let (Some((place, _)), Some(report)) = (&image, &report)
            && place.same_as(report)
        {
            return Err(AppError::usage("--output and --report name the same file", "name two files"));
        }
        keep_inputs("--output", image.as_ref().map(|(place, _)| place), &given.scene)?;
        keep_inputs("--report", report.as_ref(), &given.scene)?;
        Ok(Self { image, report })
    }

    /// Returns the state of the picture with this key: of its image, and of its report if one is wanted at
    /// this place.
    pub(super) fn standing(&self, given: &RenderArguments, key: &str) -> Result<ImageState, AppError> {
        let Some((place, format)) = self.image.as_ref().filter(|(place, _)| !place.is_stdout()) else {
            return Ok(ImageState::Missing);
        };
        let shard = given.shard.filter(|_| given.frames.is_none());
        let found = standing(place.named(), *format, &image_key(key, *format, given.tone.tone(), shard))?;
        let reported = |place: &Destination| key_of_report(place.named()).as_deref() == Some(key);
        Ok(match found {
            ImageState::Same if !self.report.as_ref().is_none_or(reported) => ImageState::Unreported,
            found => found,
        })
    }
}

/// True if a report of frames with this name gets a row for each frame.
fn takes_rows(path: &Path) -> bool {
    numbered(path, 0).is_none() && Rows::are_in(path)
}

/// Opens the report that gets a row per frame, if one was asked for.
pub(super) fn rows(given: &RenderArguments) -> Result<Option<Rows>, AppError> {
    let Some(path) = given.report.as_deref().filter(|path| given.frames.is_some() && takes_rows(path)) else {
        return Ok(None);
    };
    let rows = Rows::open(path, given.resume)?;
    keep_inputs("--report", Some(rows.place()), &given.scene)?;
    Ok(Some(rows))
}

/// Replaces the last run of # in a path's file name by a number, with as many digits or more; `None` without
/// such a run.
fn numbered(path: &Path, number: u32) -> Option<PathBuf> {
    let name = path.file_name()?.to_str()?;
    let end = name.rfind('#')? + 1;
    let begin = name[..end].trim_end_matches('#').len();
    let width = end - begin;
    Some(path.with_file_name(format!("{}{number:0width$}{}", &name[..begin], &name[end..])))
}

/// Returns file and format of the image; refuses images that the format cannot hold.
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
    check_format(path, format, !aovs.is_empty(), given.tone)?;
    if format == ImageFormat::Png && given.shard.is_some() && given.frames.is_none() {
        return Err(AppError::input(
            path,
            "a PNG cannot hold the sums of a share of the samples",
            "write an .exr, and a .png when all shares are merged",
        ));
    }
    Ok(Some((Destination::check(path)?, format)))
}

/// Refuses images that a format cannot hold.
pub(super) fn check_format(
    path: &Path,
    format: ImageFormat,
    has_aovs: bool,
    tone: ToneArguments,
) -> Result<(), AppError> {
    match (format, tone.given()) {
        (ImageFormat::Png, _) if has_aovs => Err(AppError::input(
            path,
            "a PNG cannot hold what --aov asks for",
            "write an .exr, or leave --aov out",
        )),
        (ImageFormat::Exr, Some(option)) => Err(AppError::input(
            path,
            format!("an EXR holds linear values, which {option} does not change"),
            format!("leave {option} out, or write a .png"),
        )),
        _ => Ok(()),
    }
}

/// Returns the share of the samples that was asked for; `None` for all.
///
/// # Errors
/// The share has no samples.
pub(super) fn samples_shard(given: &RenderArguments) -> Result<Option<Shard>, AppError> {
    let Some(shard) = given.shard.filter(|_| given.frames.is_none()) else { return Ok(None) };
    let spp = given.frame()?.spp;
    if shard.samples(spp).count() == 0 {
        return Err(AppError::usage(
            format!("--shard {shard} has none of {spp} samples per pixel"),
            "make no more shares than there are samples",
        ));
    }
    Ok(Some(shard))
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

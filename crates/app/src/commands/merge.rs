//! `rasray merge`.

use super::images::write_image;
use super::picture_targets::check_format;
use crate::arguments::MergeArguments;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::{
    Destination, ImageFormat, Metadata, PartFile, Row, Rows, decode_part, image_key, lines, read_rows,
};
use crate::terminal;
use rasray_experiment::RenderOutput;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Puts shares of a picture's samples, or reports of frames, together.
///
/// # Errors
/// Parts that do not go together, named; parts that do not make a whole.
pub(crate) fn merge(given: &MergeArguments, interrupt: &Interrupt) -> Result<(), AppError> {
    let place = Destination::check(&given.out)?;
    if let Some(part) = given.parts.iter().find(|part| place.is(part)) {
        return Err(AppError::input(part, "is a part and the result as well", "name another file first"));
    }
    if Rows::are_in(&given.out) {
        return merge_rows(given, &place, interrupt);
    }
    let format = ImageFormat::of(&given.out)?;
    check_format(&given.out, format, false, given.exposure)?;
    let parts = in_order(&given.parts)?;
    let (mut output, metadata) = add(&parts)?;
    let exposure = given.exposure.unwrap_or(0.0);
    let has_aovs = output.depth.is_some() || output.normal.is_some() || output.primitive.is_some();
    check_format(&given.out, format, has_aovs, given.exposure)?;
    output.samples_done = metadata.spp;
    let key = metadata.part.as_ref().map(|part| image_key(&part.picture, format, exposure, None));
    let metadata = Metadata { key, part: None, samples: metadata.spp, ..metadata };
    write_image((&place, format), &output, &metadata, exposure, interrupt)?;
    terminal::note(&format!("{} parts hold {} samples per pixel", parts.len(), metadata.spp));
    Ok(())
}

fn read(path: &Path) -> Result<PartFile, AppError> {
    let help = "make it again: rasray render with --shard and --output PART.exr";
    let bytes = std::fs::read(path)
        .map_err(|error| AppError::input(path, format!("cannot be read: {error}"), help))?;
    decode_part(bytes).map_err(|error| AppError::input(path, error, help))
}

/// The parts in the order of their first samples, in which they are added whatever order they were named in. Refuses parts
/// that do not make one whole picture.
fn in_order(parts: &[PathBuf]) -> Result<Vec<&Path>, AppError> {
    let mut first: Option<(&Path, String)> = None;
    let mut holders: Vec<Option<&Path>> = Vec::new();
    for path in parts {
        let PartFile { metadata, part, .. } = read(path)?;
        match &first {
            None => {
                holders.resize(metadata.spp as usize, None);
                first = Some((path, part.picture));
            }
            Some((other, picture)) if *picture != part.picture => {
                return Err(AppError::input(
                    path,
                    format!("is of another picture than {}", other.display()),
                    "merge parts of the same scene, options and program",
                ));
            }
            Some(_) => {}
        }
        for sample in part.shard.samples(metadata.spp) {
            let Some(holder) = holders.get_mut(sample as usize) else { continue };
            if let Some(other) = holder.replace(path) {
                return Err(AppError::input(
                    path,
                    format!("holds sample {sample}, which {} holds as well", other.display()),
                    "name each share once",
                ));
            }
        }
    }
    let missing: Vec<_> =
        holders.iter().enumerate().filter(|(_, holder)| holder.is_none()).map(|(sample, _)| sample).collect();
    if let Some(sample) = missing.first() {
        return Err(AppError::refused(
            format!("{} of {} samples are in no part, sample {sample} first", missing.len(), holders.len()),
            "nothing was written; name the parts of all shares",
        ));
    }
    let mut ordered: Vec<&Path> = Vec::new();
    for holder in holders.into_iter().flatten() {
        if ordered.len() == parts.len() {
            break;
        }
        if !ordered.contains(&holder) {
            ordered.push(holder);
        }
    }
    Ok(ordered)
}

/// Adds the parts: one after the other in f64, so that the sums of the parts are the only ones that are rounded. Further
/// images are those of the part with the first sample.
fn add(parts: &[&Path]) -> Result<(RenderOutput, Metadata), AppError> {
    let mut sums: Vec<[f64; 3]> = Vec::new();
    let mut counts: Vec<u32> = Vec::new();
    let mut whole: Option<(RenderOutput, Metadata)> = None;
    for path in parts {
        let wrong = |error: String| AppError::input(path, error, "make it again");
        let file = read(path)?;
        let metadata = file.metadata.clone();
        let mut output = file.pixels().map_err(wrong)?;
        let film = output.sums.take().unwrap_or_default();
        let pixels = output.width as usize * output.height as usize;
        let (_, first) = whole.get_or_insert_with(|| {
            sums.resize(pixels, [0.0; 3]);
            counts.resize(pixels, 0);
            (output, metadata.clone())
        });
        let picture = |metadata: &Metadata| metadata.part.as_ref().map(|part| part.picture.clone());
        if film.sums.len() != sums.len() || picture(first) != picture(&metadata) {
            return Err(wrong(
                "changed while it was read, or has another size than the other parts".to_owned(),
            ));
        }
        for (sum, part) in sums.iter_mut().zip(&film.sums) {
            for (sum, part) in sum.iter_mut().zip(part) {
                *sum += f64::from(*part);
            }
        }
        counts.iter_mut().zip(&film.counts).for_each(|(count, part)| *count += part);
    }
    let (mut output, metadata) =
        whole.ok_or_else(|| AppError::usage("there are no parts", "name the parts behind the result"))?;
    let mean = |(sum, count): (&[f64; 3], &u32)| sum.map(|sum| (sum / f64::from((*count).max(1))) as f32);
    output.beauty = sums.iter().zip(&counts).map(mean).collect();
    Ok((output, metadata))
}

/// Puts rows of reports together: in the order of frames, each picture once.
fn merge_rows(given: &MergeArguments, place: &Destination, interrupt: &Interrupt) -> Result<(), AppError> {
    let mut rows: BTreeMap<u32, (Row, &Path)> = BTreeMap::new();
    for path in &given.parts {
        if !path.is_file() {
            return Err(AppError::input(path, "there is no such file", "name reports of frames, .jsonl"));
        }
        for row in read_rows(path)? {
            match rows.get(&row.frame) {
                Some((known, _)) if known.key == row.key => {}
                Some((known, other)) => {
                    return Err(AppError::input(
                        path,
                        format!("has another picture of frame {} than {}", known.frame, other.display()),
                        "merge reports of the same scene, options and program",
                    ));
                }
                None => _ = rows.insert(row.frame, (row, path)),
            }
        }
    }
    place.write(lines(rows.values().map(|(row, _)| row)).as_bytes(), interrupt)?;
    terminal::note(&format!("{} frames of {} reports", rows.len(), given.parts.len()));
    Ok(())
}

//! Command `rasray merge`.

use super::denoise::{denoise, denoiser, key_of_denoised};
use super::images::write_image;
use super::merge_cells::{cells_are_in, merge_cells};
use super::picture_targets::check_format;
use super::targets::Form;
use crate::arguments::MergeArguments;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::{
    Destination, ImageFormat, Metadata, PartFile, Row, Rows, decode_part, image_key, lines, read_rows,
};
use crate::terminal;
use rasray_experiment::{Aov, RenderOutput, Shard};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Merges shares of a picture's samples, or reports of frames.
///
/// # Errors
/// Parts do not go together (the message names them), or do not make a whole.
pub(crate) fn merge(given: &MergeArguments, interrupt: &Interrupt) -> Result<(), AppError> {
    let place = Destination::check(&given.out)?;
    if let Some(part) = given.parts.iter().find(|part| place.is(part)) {
        return Err(AppError::input(part, "is a part and the result as well", "name another file first"));
    }
    if Rows::are_in(&given.out) || Form::named(&given.out).is_some() {
        let denoise = given.denoise.then_some("--denoise");
        if let Some(option) = given.tone.given().or(denoise) {
            let what = format!("{option} is of pictures, and these are reports");
            return Err(AppError::usage(what, "leave it out"));
        }
        return if Form::named(&given.out).is_some() || cells_are_in(given) {
            merge_cells(given, &place, interrupt)
        } else {
            merge_rows(given, &place, interrupt)
        };
    }
    let format = ImageFormat::of(&given.out)?;
    check_format(&given.out, format, false, given.tone)?;
    let denoiser = denoiser(given.denoise)?;
    let parts = in_order(&given.parts)?;
    let (mut output, metadata) = add(&parts)?;
    let tone = given.tone.tone();
    // A PNG need not hold the images that only the denoiser reads.
    let is_read = |aov: &Aov| denoiser.is_some() && Aov::FOR_DENOISING.contains(aov);
    let is_kept = |aov: &Aov| format == ImageFormat::Exr || !is_read(aov);
    check_format(&given.out, format, output.aovs.keys().any(is_kept), given.tone)?;
    if let Some(denoiser) = &denoiser {
        // The part with the first sample holds the additional images.
        if let (Some(lacking), Some(first)) =
            (Aov::FOR_DENOISING.into_iter().find(|aov| !output.aovs.contains_key(aov)), parts.first())
        {
            let message = format!("has no {}, which --denoise reads", lacking.name());
            let help = "make the parts again with --aov albedo,normal, or leave --denoise out";
            return Err(AppError::input(first, message, help));
        }
        denoise(denoiser, &mut output)?;
        output.aovs.retain(|aov, _| is_kept(aov));
    }
    output.samples_done = metadata.spp;
    let picture = metadata.part.as_ref().map(|part| key_of_denoised(part.picture.clone(), denoiser.as_ref()));
    let key = picture.map(|picture| image_key(&picture, format, tone, None));
    let denoised = denoiser.as_ref().map(|denoiser| denoiser.version().to_owned());
    let metadata = Metadata { key, part: None, samples: metadata.spp, denoised, ..metadata };
    write_image((&place, format), &output, &metadata, tone, interrupt)?;
    terminal::note(&format!("{} parts hold {} samples per pixel", parts.len(), metadata.spp));
    Ok(())
}

fn read(path: &Path) -> Result<PartFile, AppError> {
    let help = "make it again: rasray render with --shard and --output PART.exr";
    let bytes = std::fs::read(path)
        .map_err(|error| AppError::input(path, format!("cannot be read: {error}"), help))?;
    decode_part(bytes).map_err(|error| AppError::input(path, error, help))
}

/// Orders the parts by their first samples, the order in which they are added whatever order they were named
/// in. Refuses parts that do not make one whole picture.
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

/// Adds the parts one after another in f64, so that only the sums of the parts are rounded. Additional images
/// are those of the part with the first sample.
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

/// Merges rows of reports in the order of frames, each picture once.
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
                        SAME,
                    ));
                }
                None => _ = rows.insert(row.frame, (row, path)),
            }
        }
    }
    check_rows(&rows)?;
    place.write(lines(rows.values().map(|(row, _)| row)).as_bytes(), interrupt)?;
    terminal::note(&format!("{} frames of {} reports", rows.len(), given.parts.len()));
    Ok(())
}

/// Advice for rows that do not go together.
const SAME: &str = "merge reports of the same scene, options and program";

/// Request of a command for frames, from the first to the last.
struct FrameRequest<'a> {
    /// First row with this request, and its file.
    by: (&'a Row, &'a Path),
    key: &'a str,
    /// Number of shares, if all rows are of shares of one division.
    of: Option<u32>,
}

/// Refuses rows of different commands, and rows that are not everything that one of these commands and its
/// other shares make.
fn check_rows(rows: &BTreeMap<u32, (Row, &Path)>) -> Result<(), AppError> {
    let Some((first, from)) = rows.values().next() else { return Ok(()) };
    let mut asked: BTreeMap<(u32, u32), FrameRequest<'_>> = BTreeMap::new();
    for (row, path) in rows.values() {
        let differs = |other: &Row, file: &Path| {
            let of = format!("of frame {} in {}", other.frame, file.display());
            AppError::input(path, format!("has frame {} of another command than that {of}", row.frame), SAME)
        };
        if row.common != first.common || row.frames.is_some() != first.frames.is_some() {
            return Err(differs(first, from));
        }
        let Some(frames) = &row.frames else { continue };
        let of = frames.shard.as_deref().and_then(Shard::parse).map(Shard::count);
        let known = asked.entry((frames.first, frames.last)).or_insert(FrameRequest {
            by: (row, path),
            key: &frames.key,
            of,
        });
        if known.key != frames.key {
            return Err(differs(known.by.0, known.by.1));
        }
        known.of = known.of.filter(|known| of == Some(*known));
    }
    asked.into_iter().try_for_each(|(range, asked)| check_complete(rows, range, &asked))
}

/// Refuses rows in which one of the frames from `first` to `last` is missing.
fn check_complete(
    rows: &BTreeMap<u32, (Row, &Path)>,
    (first, last): (u32, u32),
    asked: &FrameRequest<'_>,
) -> Result<(), AppError> {
    let mut missing: Vec<(u32, u32)> = Vec::new();
    let mut next = u64::from(first);
    for held in rows.range(first..=last).map(|(frame, _)| *frame).map(u64::from).chain([u64::from(last) + 1])
    {
        if held > next {
            missing.push((next as u32, (held - 1) as u32));
        }
        next = held + 1;
    }
    if missing.is_empty() {
        return Ok(());
    }
    let count: u64 = missing.iter().map(|(from, to)| u64::from(to - from) + 1).sum();
    let all = u64::from(last - first) + 1;
    let mut message = format!(
        "is of frames {first}-{last}, of which {count} of {all} are in no report: {}",
        listed(&missing)
    );
    if let Some(of) = asked.of {
        let held: BTreeSet<u32> =
            rows.range(first..=last).map(|(frame, _)| (frame - first) % of + 1).collect();
        // These shares are missing entirely, unless they have no frames.
        let shares = (1..=of.min(all.min(u32::MAX.into()) as u32)).filter(|number| !held.contains(number));
        let shares: Vec<_> = shares.take(LISTED + 1).map(|number| (number, number)).collect();
        if !shares.is_empty() {
            let which = if shares.len() == 1 { "share" } else { "shares" };
            message += &format!("; nothing of {which} {} of {of} is there", listed(&shares));
        }
    }
    let help = "nothing was written; name the reports of all shares, or make the frames with the same command and --resume";
    Err(AppError::input(asked.by.1, message, help))
}

/// Largest number of ranges that a message lists.
const LISTED: usize = 8;

/// Writes ranges in words: `4, 6, 9-12`.
fn listed(ranges: &[(u32, u32)]) -> String {
    let range = |(from, to): &(u32, u32)| if from == to { from.to_string() } else { format!("{from}-{to}") };
    let mut words: Vec<_> = ranges.iter().take(LISTED).map(range).collect();
    if ranges.len() > LISTED {
        words.push("and more".to_owned());
    }
    words.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lists_of_frames_are_cut() {
        assert_eq!(listed(&[(4, 4), (6, 6), (9, 12)]), "4, 6, 9-12");
        let many: Vec<_> = (0..20).map(|number| (2 * number, 2 * number)).collect();
        assert_eq!(listed(&many), "0, 2, 4, 6, 8, 10, 12, 14, and more");
    }
}

//! Command `rasray merge` for comparisons: shares of the cells as one report.

use super::targets::Form;
use crate::arguments::MergeArguments;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::{CellLines, Destination, assembled, difference, read_cells, text_of};
use crate::terminal;
use rasray_report::figures::Figures;
use rasray_report::{Campaign, Report};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

/// True if the first line of the parts is the cell of a comparison.
pub(super) fn cells_are_in(given: &MergeArguments) -> bool {
    let first = |path: &Path| {
        let mut line = Vec::new();
        BufReader::new(File::open(path).ok()?).read_until(b'\n', &mut line).ok()?;
        serde_json::from_slice::<Report>(&line).ok()
    };
    given.parts.iter().find_map(|part| first(part)).is_some_and(|report| report.cell.is_some())
}

/// Merges the cells of a comparison in their order, each once.
///
/// # Errors
/// Lines are of different comparisons, programs or devices (the message names the file), or cells are in no
/// file.
pub(super) fn merge_cells(
    given: &MergeArguments,
    place: &Destination,
    interrupt: &Interrupt,
) -> Result<(), AppError> {
    let mut cells: BTreeMap<u32, (Report, &Path)> = BTreeMap::new();
    let mut first: Option<(Report, &Path)> = None;
    let mut all = 0;
    for path in &given.parts {
        if !path.is_file() {
            let help = "name reports of rasray compare with a line per run, .jsonl";
            return Err(AppError::input(path, "there is no such file", help));
        }
        let CellLines { lines, .. } = read_cells(path)?;
        for (number, (record, line)) in lines.into_iter().enumerate() {
            let (known, other) = first.get_or_insert_with(|| (line.clone(), path));
            let differs = difference(&line, known).or_else(|| {
                let twin = cells.get(&record.place).and_then(|(twin, _)| twin.cell.as_ref());
                let is_twin = twin.is_none_or(|twin| twin.key == record.key);
                let is_whole = is_twin && record.place < record.cells;
                (!is_whole).then(|| "is of a cell that its comparison does not have".to_owned())
            });
            if let Some(differs) = differs {
                let message = format!("line {}: {differs}, as {} has it", number + 1, other.display());
                let help = "merge shares of the same command, program and device";
                return Err(AppError::input(path, message, help));
            }
            all = record.cells;
            cells.entry(record.place).or_insert((line, path));
        }
    }
    let Some((_, path)) = first else {
        let help = "name reports of rasray compare with a line per run, .jsonl";
        return Err(AppError::input(&given.parts[0], "holds no cell of a comparison", help));
    };
    let missing: Vec<_> = (0..all).filter(|place| !cells.contains_key(place)).collect();
    if let Some(place) = missing.first() {
        let message = format!(
            "is of a comparison of {all} cells, of which {} are in no report, cell {place} first",
            missing.len()
        );
        let help = "nothing was written; name the reports of all shares, or make the cells with the same command and --resume";
        return Err(AppError::input(path, message, help));
    }
    let lines = || cells.values().map(|(line, _)| line);
    let bytes = match (Form::named(&given.out), Campaign::of(lines()), assembled(lines())) {
        (Some(form), Some(campaign), _) => form.of_campaign(&campaign)?,
        (Some(form), None, Some(report)) => form.of(&report, &Figures::default())?,
        _ => lines().map(text_of).collect::<String>().into(),
    };
    place.write(&bytes, interrupt)?;
    terminal::note(&format!("{} cells of {} reports", cells.len(), given.parts.len()));
    Ok(())
}

//! Pictures of an experiment on one sheet, and what stands under each.

use crate::paper::{Item, Paper};
use rasray_report::{Experiment, Row, in_line};
use std::fmt::Write;

/// Pictures in a row of a sheet.
pub const SHEET_COLUMNS: usize = 4;

/// The pictures of an experiment that makes images.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sheet {
    /// Its file, beside the page.
    pub file: String,
    /// Of each picture the key of its run and the caption, row by row.
    pub pictures: Vec<(String, String)>,
}

impl Sheet {
    /// That of an experiment of an item, by its number among the item's; `None` where it makes no images. The reference, with
    /// the seed that shows what noise alone does, stands before the runs that are compared with it.
    pub(crate) fn of(paper: &Paper, item: &Item, number: usize, made: &Experiment) -> Option<Self> {
        let images =
            made.parts().into_iter().find(|part| part.rows.iter().all(|row| row.run().ray_set.is_none()))?;
        let varied: Vec<_> = images.varied().into_iter().map(str::to_owned).collect();
        let is_reference = |row: &&Row| row.setting("system") == "reference";
        let (mut rows, others): (Vec<_>, Vec<_>) = images.rows.iter().partition(is_reference);
        rows.extend(others);
        let caption = |row: &Row| {
            let words =
                varied.iter().filter(|name| *name != "seed" && !(is_reference(&row) && *name == "preset"));
            let words = words.filter_map(|name| match (name.as_str(), row.setting(name)) {
                (_, "") => None,
                ("scene" | "system" | "preset" | "integrator", value) => Some(value.to_owned()),
                (name, value) => Some(format!("{name} {value}")),
            });
            words.collect::<Vec<_>>().join(", ")
        };
        let suffix = if number == 0 { String::new() } else { format!("-{}", number + 1) };
        Some(Self {
            file: format!("{}-{}{suffix}.png", paper.name, item.name),
            pictures: rows.into_iter().map(|row| (row.key.clone(), caption(row))).collect(),
        })
    }

    /// The picture, and its captions in a table of the same shape.
    pub(crate) fn markdown(&self) -> String {
        let mut text =
            format!("![{} pictures, row by row as in the table]({})\n\n", self.pictures.len(), self.file);
        let columns = self.pictures.len().min(SHEET_COLUMNS);
        _ = writeln!(text, "|{}\n|{}", "  |".repeat(columns), " --- |".repeat(columns));
        for row in self.pictures.chunks(SHEET_COLUMNS) {
            for (_, caption) in row {
                _ = write!(text, "| {} ", in_line(caption).replace('|', "\\|"));
            }
            text += "|\n";
        }
        text + "\n"
    }
}

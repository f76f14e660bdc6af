//! Pictures of an experiment on one sheet.

use crate::paper::{Item, Paper};
use rasray_report::Experiment;

/// Pictures in a row of a sheet.
pub const SHEET_COLUMNS: usize = 4;

/// The pictures of an experiment that makes images.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sheet {
    /// Its file, beside the page.
    pub file: String,
    /// Keys of the runs that made them, row by row.
    pub pictures: Vec<String>,
}

impl Sheet {
    /// That of the images of an experiment of an item, by its number among the item's, in their order.
    pub(crate) fn of(paper: &Paper, item: &Item, number: usize, images: &Experiment) -> Self {
        let suffix = if number == 0 { String::new() } else { format!("-{}", number + 1) };
        Self {
            file: format!("{}-{}{suffix}.png", paper.name, item.name),
            pictures: images.rows.iter().map(|row| row.key.clone()).collect(),
        }
    }

    /// The picture.
    pub(crate) fn markdown(&self) -> String {
        let count = self.pictures.len();
        format!("![{count} pictures, row by row in the order of the table of images]({})\n\n", self.file)
    }
}

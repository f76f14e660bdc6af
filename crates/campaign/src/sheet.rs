//! Sheet with the pictures of an experiment.

use crate::paper::{Item, Paper};
use rasray_report::Experiment;

/// Number of pictures in a row of a sheet.
pub const SHEET_COLUMNS: usize = 4;

/// Sheet with the pictures of an experiment that makes images.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sheet {
    /// Name of the sheet's file, in the folder of the page.
    pub file: String,
    /// Keys of the runs that made the pictures, row by row.
    pub pictures: Vec<String>,
}

impl Sheet {
    /// Returns the sheet for the images of an experiment, in their order, given its item and its number among
    /// the item's experiments.
    pub(crate) fn of(paper: &Paper, item: &Item, number: usize, images: &Experiment) -> Self {
        let suffix = if number == 0 { String::new() } else { format!("-{}", number + 1) };
        Self {
            file: format!("{}-{}{suffix}.png", paper.name, item.name),
            pictures: images.rows.iter().map(|row| row.key.clone()).collect(),
        }
    }

    /// Returns the sheet as a picture in Markdown.
    pub(crate) fn markdown(&self) -> String {
        let count = self.pictures.len();
        format!("![{count} pictures, row by row in the order of the table of images]({})\n\n", self.file)
    }
}

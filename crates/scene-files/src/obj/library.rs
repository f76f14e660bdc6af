//! The statement `mtllib`.

use std::path::Path;

use crate::reference::{Place, place};

/// A `mtllib` statement.
pub(super) struct Library {
    /// All that follows the word.
    pub name: String,
}

impl Library {
    /// Names of files and where they lead. The statement may name one file with spaces or several files: one
    /// if that exists, or one of its name beside the scene does.
    pub fn files(&self, folder: &Path) -> Vec<(&str, Place)> {
        let is_one = match place(folder, &self.name) {
            Place::Below(file) => file.is_file(),
            Place::Outside { beside, .. } => beside.is_some_and(|file| file.is_file()),
        };
        let names: Vec<&str> =
            if is_one { vec![self.name.as_str()] } else { self.name.split_whitespace().collect() };
        names.into_iter().map(|name| (name, place(folder, name))).collect()
    }
}

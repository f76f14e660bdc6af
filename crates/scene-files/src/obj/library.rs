//! Reader of the statement `mtllib`.

use std::path::Path;

use crate::reference::{Place, place};

/// Statement `mtllib`.
pub(super) struct Library {
    /// Text after the word.
    pub name: String,
}

impl Library {
    /// Returns the names of files and their targets. The statement may name one file with spaces or several
    /// files; it names one file if that exists, or if a file of its name exists beside the scene.
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

//! What of an OBJ file is not shown.

use super::statements::Statement;
use crate::remarks::Remarks;

/// Counts of what is not shown.
#[derive(Default)]
pub(super) struct Skipped {
    pub points_and_lines: usize,
    /// Faces with fewer than three corners.
    pub faces: usize,
    /// Vertices with colours.
    pub colors: usize,
    unknown: usize,
    /// The first unknown word and where it is.
    pub first_unknown: Option<(String, String)>,
}

impl Skipped {
    pub fn note_unknown(&mut self, statement: &Statement<'_>) {
        self.unknown += 1;
        self.first_unknown.get_or_insert_with(|| {
            (String::from_utf8_lossy(&statement.word).chars().take(40).collect(), statement.place())
        });
    }

    pub fn report(&self, remarks: &mut Remarks) {
        let text = "point and line statements are not shown: only triangles are rendered";
        remarks.count("points-and-lines", "", self.points_and_lines, text);
        let text = "faces have fewer than three corners and were dropped";
        remarks.count("short-faces", "", self.faces, text);
        let text = "vertices have colours, which are ignored in OBJ files";
        remarks.count("vertex-colors", "", self.colors, text);
        if let Some((word, place)) = &self.first_unknown {
            let text = format!(
                "statements of unknown or unsupported kinds were skipped, the first is `{word}` in {place}"
            );
            remarks.count("unknown-statements", "", self.unknown, text);
        }
    }
}

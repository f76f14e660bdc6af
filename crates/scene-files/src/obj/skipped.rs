//! Parts of an OBJ file that are not shown, or not shown as written.

use super::statements::Statement;
use crate::kinds::Kinds;
use crate::polygon::CROSSING;
use rasray_scene::remarks::Remarks;

/// Counts of the parts that are not shown.
#[derive(Default)]
pub(super) struct Skipped {
    pub points_and_lines: usize,
    /// Number of faces with fewer than three corners.
    pub faces: usize,
    /// Number of faces whose sides cross.
    pub crossing: usize,
    /// Number of faces some of whose corners lack an attribute that others have.
    pub partial: usize,
    /// Number of vertices with colours.
    pub colors: usize,
    /// Number of vertices with a weight that is not 1.
    pub weights: usize,
    unknown: Kinds,
    /// First unknown word and its place.
    pub first_unknown: Option<(String, String)>,
}

impl Skipped {
    pub fn note_unknown(&mut self, statement: &Statement<'_>) {
        let word: String = String::from_utf8_lossy(&statement.word).chars().take(40).collect();
        self.unknown.note(&word);
        self.first_unknown.get_or_insert_with(|| (word, statement.place()));
    }

    pub fn report(&self, remarks: &mut Remarks) {
        let text = "point and line statements are not shown: only triangles are rendered";
        remarks.count("points-and-lines", "", self.points_and_lines, text);
        let text = "faces have fewer than three corners and were dropped";
        remarks.count("short-faces", "", self.faces, text);
        remarks.count("crossing-faces", "", self.crossing, CROSSING);
        let text =
            "faces have texture coordinates or normals at some of their corners only; these were dropped";
        remarks.count("partial-attributes", "", self.partial, text);
        let text = "vertices have colours, which are ignored in OBJ files";
        remarks.count("vertex-colors", "", self.colors, text);
        let text = "vertices have a weight, which only free-form surfaces use";
        remarks.count("vertex-weights", "", self.weights, text);
        if let Some((word, place)) = &self.first_unknown {
            let text = format!(
                "statements of unknown or unsupported kinds were skipped, the first is `{word}` in {place}: {}",
                self.unknown.list(|_| true)
            );
            remarks.count("unknown-statements", "", self.unknown.sum(), text);
        }
    }
}

//! Remarks of a reader on a file: collected while the file is read, reported once.

use std::collections::HashMap;
use std::path::PathBuf;

use crate::text::{sentence, shown};
use crate::warning::Warning;

/// Largest number of texts of one kind that are reported; more are counted, so that no file can make the list
/// long.
const TEXTS: usize = 16;

/// Remarks on the places of a file, and the files that were read for it. Equal remarks on many places become
/// one warning.
#[derive(Debug, Default)]
pub struct Remarks {
    /// Files in the order in which they were read.
    pub files: Vec<PathBuf>,
    list: Vec<Remark>,
    /// Index into `list` by kind and text.
    known: HashMap<(&'static str, String), usize>,
    /// Number of texts of each kind, and the index of the last one that is reported.
    kinds: HashMap<&'static str, (usize, usize)>,
}

#[derive(Debug)]
struct Remark {
    kind: &'static str,
    /// Place of the first remark; empty for the file as a whole.
    place: String,
    /// Place of the last remark.
    last: String,
    /// Number of places after the first.
    more: usize,
    /// Sum of the counts over all places, for remarks that have counts.
    count: Option<u64>,
    text: String,
    /// Number of remarks of this kind that are not reported.
    untold: usize,
}

impl Remarks {
    /// Notes a remark on a place: `mesh a: text`. An empty place is the file as a whole.
    pub fn note(&mut self, kind: &'static str, place: impl Into<String>, text: impl Into<String>) {
        self.add(kind, place.into(), None, text.into());
    }

    /// Notes a remark on `count` elements in a place, unless there are none: `mesh a: 3 text`. Counts of
    /// several places are added.
    pub fn count(
        &mut self,
        kind: &'static str,
        place: impl Into<String>,
        count: usize,
        text: impl Into<String>,
    ) {
        if count > 0 {
            self.add(kind, place.into(), Some(count as u64), text.into());
        }
    }

    fn add(&mut self, kind: &'static str, place: String, count: Option<u64>, text: String) {
        if let Some(&position) = self.known.get(&(kind, text.clone())) {
            let remark = &mut self.list[position];
            remark.count = remark.count.zip(count).map(|(sum, count)| sum.saturating_add(count));
            if remark.last != place {
                remark.more += 1;
                remark.last = place;
            }
            return;
        }
        let (texts, last) = self.kinds.entry(kind).or_insert((0, 0));
        if *texts == TEXTS {
            self.list[*last].untold += 1;
            return;
        }
        (*texts, *last) = (*texts + 1, self.list.len());
        self.known.insert((kind, text.clone()), self.list.len());
        let last = place.clone();
        self.list.push(Remark { kind, place, last, more: 0, count, text, untold: 0 });
    }

    /// Joins the messages of the given kinds into one sentence.
    pub fn sentence(&self, kinds: &[&str]) -> String {
        let chosen = self.list.iter().filter(|remark| kinds.contains(&remark.kind));
        chosen.map(Remark::message).collect::<Vec<_>>().join("; ")
    }

    /// Turns the remarks into warnings, one per text, in the order of their first occurrence.
    pub fn into_warnings(self) -> impl Iterator<Item = Warning> {
        self.list.into_iter().map(|remark| Warning { kind: remark.kind, message: remark.message() })
    }
}

impl Remark {
    fn message(&self) -> String {
        let mut message = shown(&self.place);
        if self.more > 0 {
            message += &format!(" and {} more", self.more);
        }
        if !message.is_empty() {
            message += ": ";
        }
        if let Some(count) = self.count {
            message += &format!("{count} ");
        }
        message += &sentence(&self.text);
        if self.untold > 0 {
            message += &format!(" ({} more remarks of this kind are not listed)", self.untold);
        }
        message
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn messages(remarks: Remarks) -> Vec<String> {
        remarks.into_warnings().map(|warning| warning.message).collect()
    }

    #[test]
    fn the_same_remark_on_many_places_is_one_warning() {
        let mut remarks = Remarks::default();
        for mesh in 0..98 {
            remarks.count("normals", format!("mesh {mesh}"), 2, "normals are bad");
            remarks.note("flat", format!("mesh {mesh}"), "is flat");
        }
        remarks.count("normals", "mesh 7", 0, "normals are missing");
        remarks.note("flat", "", "all is flat");
        assert_eq!(
            messages(remarks),
            ["mesh 0 and 97 more: 196 normals are bad", "mesh 0 and 97 more: is flat", "all is flat"]
        );
    }

    #[test]
    fn a_place_counts_once() {
        let mut remarks = Remarks::default();
        remarks.count("a", "mesh", 2, "things");
        remarks.count("a", "mesh", 3, "things");
        assert_eq!(messages(remarks), ["mesh: 5 things"]);
    }

    #[test]
    fn no_file_makes_the_list_long() {
        let mut remarks = Remarks::default();
        for number in 0..1000 {
            remarks.note("many", "file", format!("remark {number} {}", "x".repeat(10_000)));
        }
        remarks.note("other", "file", "is told");
        let messages = messages(remarks);
        assert_eq!(messages.len(), TEXTS + 1);
        assert!(messages[TEXTS - 1].ends_with("(984 more remarks of this kind are not listed)"));
        assert!(messages.iter().all(|message| message.len() < 1000));
    }
}

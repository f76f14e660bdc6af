//! Counts of omitted elements by kind.

use std::collections::BTreeMap;

use rasray_scene::text::shown;

/// Counts by kind, in alphabetical order.
#[derive(Debug, Default)]
pub(crate) struct Kinds {
    counts: BTreeMap<String, usize>,
}

impl Kinds {
    /// Largest number of kinds that are counted apart; others are counted together, so that no file can make
    /// a message long.
    const MOST: usize = 24;

    /// Counts one more element of a kind.
    pub fn note(&mut self, what: &str) {
        self.add(what, 1);
    }

    /// Counts more elements of a kind.
    pub fn add(&mut self, what: &str, count: usize) {
        let what: String = what.chars().take(40).collect();
        let known = self.counts.contains_key(&what) || self.counts.len() < Self::MOST;
        *self.counts.entry(if known { what } else { "others".to_owned() }).or_default() += count;
    }

    /// Returns the number of all elements.
    pub fn sum(&self) -> usize {
        self.counts.values().sum()
    }

    /// Lists the kinds for which `is_wanted` holds: `vp (3), cstype (1)`. Empty if there are none.
    pub fn list(&self, is_wanted: impl Fn(&str) -> bool) -> String {
        let wanted = self.counts.iter().filter(|(what, _)| is_wanted(what));
        wanted.map(|(what, count)| format!("{} ({count})", shown(what))).collect::<Vec<_>>().join(", ")
    }
}

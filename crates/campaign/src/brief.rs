//! Experiments in the short form of a paper's page. The page has every setting once, as high on the page as
//! it is valid, every run once, and only the results that the page is about. `report.md` and `table.csv` have
//! all other results.

use rasray_report::{Column, Experiment, Row};
use std::collections::BTreeSet;

/// Names ([`Row::results`]) of the results that a page shows if the plan names none.
const SHOWN: [&str; 8] = [
    "build_ms",
    "trace_ms",
    "memory.structure_bytes",
    "error_share",
    "accuracy.dt_rel_p99",
    "image_ms",
    "image.flip_mean",
    "image.relmse",
];

/// Results that a table of images leaves out if it is below a table of rays, which has them.
const OF_STRUCTURE: [&str; 2] = ["build_ms", "memory.structure_bytes"];

/// Settings that may decide others. A setting is told with the first of these that decides it.
const DECIDING: [&str; 4] = ["integrator", "system", "scene", "preset"];

/// Settings that need no column, since all rows have them in common, or since they follow from another
/// setting.
#[derive(Clone, Debug, Default)]
pub(crate) struct SharedSettings {
    names: BTreeSet<String>,
    words: Vec<String>,
}

impl SharedSettings {
    /// Returns the settings that need no column for these rows. The page has already told the settings of
    /// `before`, of these and of other rows.
    pub(crate) fn of(rows: &[&Row], before: &Self) -> Self {
        let all = Experiment { name: String::new(), rows: rows.iter().copied().cloned().collect() };
        let (settings, varied) = (all.settings(), all.varied());
        let new = |name: &&str| !before.names.contains(*name);
        let mut said = Self { names: before.names.clone(), words: Vec::new() };
        let Some(first) = rows.first() else { return said };
        let common: Vec<_> = settings.into_iter().filter(|name| !varied.contains(name)).filter(new).collect();
        if !common.is_empty() {
            let words = common.iter().map(|name| format!("{name} {}", first.setting(name)));
            said.words.push(words.collect::<Vec<_>>().join(", "));
        }
        said.names.extend(common.into_iter().map(str::to_owned));
        for decides in DECIDING.into_iter().filter(|name| varied.contains(name)) {
            if said.names.contains(decides) {
                continue;
            }
            // A scene, system or integrator names a row, so it keeps its column even if another setting
            // decides it.
            let follows = |name: &&str| {
                let names_rows = DECIDING.contains(name) && *name != "preset";
                let is_told = *name == decides || said.names.contains(*name);
                !names_rows && !is_told && is_decided(rows, decides, name)
            };
            let decided: Vec<_> = varied.iter().copied().filter(follows).collect();
            said.words.extend(words_of(rows, decides, &decided));
            said.names.extend(decided.into_iter().map(str::to_owned));
        }
        said
    }

    /// Returns these settings together with the other ones; the words stay.
    pub(crate) fn and(mut self, other: &Self) -> Self {
        self.names.extend(other.names.iter().cloned());
        self
    }

    /// Returns the settings that are in both, without words.
    pub(crate) fn shared(&self, other: &Self) -> Self {
        Self { names: self.names.intersection(&other.names).cloned().collect(), words: Vec::new() }
    }

    /// Returns the settings that are new on the page, in words.
    pub(crate) fn words(&self) -> &[String] {
        &self.words
    }

    /// Returns the settings in which rows differ and that the page has not told.
    pub(crate) fn untold<'a>(&self, made: &'a Experiment) -> Vec<&'a str> {
        made.varied().into_iter().filter(|name| !self.names.contains(*name)).collect()
    }
}

/// Returns true if the value of the setting `decides` determines that of the setting `name`.
fn is_decided(rows: &[&Row], decides: &str, name: &str) -> bool {
    let pairs: BTreeSet<_> = rows.iter().map(|row| (row.setting(decides), row.setting(name))).collect();
    let keys: BTreeSet<_> = pairs.iter().map(|(key, _)| key).collect();
    keys.len() == pairs.len() && pairs.iter().all(|(key, value)| !key.is_empty() || value.is_empty())
}

/// Returns the settings that follow from the values of `decides`, in words and in the order of rows. Values
/// from which equal settings follow share one text.
fn words_of(rows: &[&Row], decides: &str, decided: &[&str]) -> Vec<String> {
    let mut told: Vec<(Vec<&str>, String)> = Vec::new();
    for row in rows {
        let value = row.setting(decides);
        let settings = decided.iter().filter(|name| !row.setting(name).is_empty());
        let settings: Vec<_> = settings.map(|name| format!("{name} {}", row.setting(name))).collect();
        let words = settings.join(", ");
        match told.iter_mut().find(|(_, other)| *other == words) {
            Some((values, _)) if values.contains(&value) => {}
            Some((values, _)) => values.push(value),
            None => told.push((vec![value], words)),
        }
    }
    let told = told.into_iter().filter(|(_, words)| !words.is_empty());
    told.map(|(values, words)| format!("{}: {words}", values.join(", "))).collect()
}

/// Returns the rows of an experiment with each run once. A setting that the run does not depend on has all of
/// its values.
pub(crate) fn merged(made: &Experiment) -> Experiment {
    let mut rows: Vec<Row> = Vec::new();
    for row in &made.rows {
        let Some(same) = rows.iter_mut().find(|other| other.key == row.key) else {
            rows.push(row.clone());
            continue;
        };
        for (name, value) in &row.settings {
            let own = same.settings.entry(name.clone()).or_default();
            if own.is_empty() {
                own.clone_from(value);
            } else if own.split(", ").all(|one| one != value) {
                *own += &format!(", {value}");
            }
        }
    }
    Experiment { name: made.name.clone(), rows }
}

/// Returns the columns of results that the page shows: those that the plan `names`, otherwise the usual ones.
/// `below_rays` is true if a table of rays of these structures stands above, whose results are left out.
pub(crate) fn shown(made: &Experiment, names: &[String], below_rays: bool) -> Vec<Column> {
    let is_shown = |column: &Column| {
        let is_named = names.iter().any(|name| name == column.name);
        let is_usual = names.is_empty() && SHOWN.contains(&column.name);
        (is_named || is_usual) && !(below_rays && OF_STRUCTURE.contains(&column.name))
    };
    made.columns().into_iter().filter(is_shown).collect()
}

/// Removes the columns in which all rows of each scene are alike, if every scene has several rows, and
/// returns their values in words.
pub(crate) fn take_alike(made: &Experiment, columns: &mut Vec<Column>) -> Vec<String> {
    let mut scenes: Vec<&str> = Vec::new();
    for row in &made.rows {
        if !scenes.contains(&row.setting("scene")) {
            scenes.push(row.setting("scene"));
        }
    }
    let of = |scene: &str, column: &Column| {
        let rows = made.rows.iter().filter(|row| row.setting("scene") == scene);
        rows.map(|row| column.of(row)).collect::<Vec<_>>()
    };
    let is_alike = |column: &Column| {
        scenes
            .iter()
            .map(|scene| of(scene, column))
            .all(|cells| cells.len() > 1 && cells.iter().all(|cell| *cell == cells[0]))
    };
    let (alike, others): (Vec<_>, Vec<_>) = columns.iter().partition(|column| is_alike(column));
    *columns = others;
    let words = |scene: &&str| {
        let values = alike.iter().map(|column| format!("{} {}", column.head, of(scene, column)[0]));
        let values = values.collect::<Vec<_>>().join(", ");
        if scenes.len() == 1 { values } else { format!("{scene}: {values}") }
    };
    if alike.is_empty() { Vec::new() } else { scenes.iter().map(words).collect() }
}

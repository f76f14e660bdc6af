//! An experiment as the page of a paper shows it: every setting once, as high on the page as it holds, every
//! run once, and of the results those that the page is about. All others are in `report.md` and `table.csv`.

use rasray_report::{Column, Experiment, Row};
use std::collections::BTreeSet;

/// Results that a page shows where the plan names none, by the names of [`Row::results`].
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

/// Those that a table of images leaves out below one of rays, which has them.
const OF_STRUCTURE: [&str; 2] = ["build_ms", "memory.structure_bytes"];

/// Settings by which others are told, each by the first that decides it.
const DECIDING: [&str; 4] = ["integrator", "system", "scene", "preset"];

/// Settings that need no column: what all rows have in common, and what follows from another setting.
#[derive(Clone, Debug, Default)]
pub(crate) struct SharedSettings {
    names: BTreeSet<String>,
    words: Vec<String>,
}

impl SharedSettings {
    /// Settings that need no column for these rows, where `before` has been said of them and of others.
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
            // Scene, system and integrator name a row, whatever they follow from.
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

    /// Settings that either says.
    pub(crate) fn and(mut self, other: &Self) -> Self {
        self.names.extend(other.names.iter().cloned());
        self
    }

    /// Settings that both say.
    pub(crate) fn shared(&self, other: &Self) -> Self {
        Self { names: self.names.intersection(&other.names).cloned().collect(), words: Vec::new() }
    }

    /// New settings, in words.
    pub(crate) fn words(&self) -> &[String] {
        &self.words
    }

    /// The settings that rows differ in and that have not been said.
    pub(crate) fn untold<'a>(&self, made: &'a Experiment) -> Vec<&'a str> {
        made.varied().into_iter().filter(|name| !self.names.contains(*name)).collect()
    }
}

/// True if the value of one setting says that of the other.
fn is_decided(rows: &[&Row], decides: &str, name: &str) -> bool {
    let pairs: BTreeSet<_> = rows.iter().map(|row| (row.setting(decides), row.setting(name))).collect();
    let keys: BTreeSet<_> = pairs.iter().map(|(key, _)| key).collect();
    keys.len() == pairs.len() && pairs.iter().all(|(key, value)| !key.is_empty() || value.is_empty())
}

/// Settings that follow from the values of the one that decides, in words and in the order of rows; once for
/// values from which the same follows.
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

/// The rows of an experiment, each run once: settings that the run does not depend on have all of their
/// values.
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

/// The results of an experiment that the page shows: those that the plan `names`, or else those of every
/// page; `below_rays` where a table of rays of the same structures stands above.
pub(crate) fn shown(made: &Experiment, names: &[String], below_rays: bool) -> Vec<Column> {
    let is_shown = |column: &Column| {
        let is_named = names.iter().any(|name| name == column.name);
        let is_usual = names.is_empty() && SHOWN.contains(&column.name);
        (is_named || is_usual) && !(below_rays && OF_STRUCTURE.contains(&column.name))
    };
    made.columns().into_iter().filter(is_shown).collect()
}

/// Takes those columns out in which all rows of a scene are alike, of scenes with several rows each, and says
/// them in words.
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

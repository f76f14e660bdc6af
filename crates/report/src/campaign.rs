//! Campaign: cells of many comparisons, grouped in experiments that show them together. A cell is flat:
//! settings by name, and results by name.

use crate::{Cell, Device, ExperimentRecord, Report, Run};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Results of a campaign.
#[derive(Clone, Debug, PartialEq)]
pub struct Campaign {
    /// Title of the plan, one line.
    pub title: String,
    /// Version of the program, and its commit where known.
    pub program: String,
    /// Device that the campaign ran on.
    pub device: Device,
    /// Experiments in the order of the plan.
    pub experiments: Vec<Experiment>,
}

/// Experiment: rows that are shown together.
#[derive(Clone, Debug, PartialEq)]
pub struct Experiment {
    /// Name of the experiment, one line.
    pub name: String,
    /// Rows in the order of the comparisons.
    pub rows: Vec<Row>,
}

/// Cell of a campaign with its results.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Key of the run.
    pub key: String,
    /// Settings by name, such as `scene`, `system`, `samples` or `ray-set`; a setting that the cell does not
    /// have is absent.
    pub settings: BTreeMap<String, String>,
    /// Results by name, such as `trace_ms`, `stages.film` or `counters.fragments`.
    pub results: BTreeMap<String, f64>,
    /// Report of the cell, as its line of JSON holds it.
    pub report: Report,
}

/// Settings that every cell may have, in the order in which they are shown first; options of systems and
/// integrators follow `preset`.
const BEFORE: [&str; 9] =
    ["scene", "time", "clip", "camera", "size", "back-faces", "system", "preset", "integrator"];

/// Settings that are shown last.
const AFTER: [&str; 11] = [
    "ray-set",
    "rays",
    "spp",
    "adaptive",
    "sampler",
    "primary",
    "occluder",
    "shadow-resolution",
    "shadow-points",
    "seed",
    "repetitions",
];

/// Settings of a plan that are evident from its cells and are not shown.
const SEEN: [&str; 2] = ["image", "statistics"];

/// Fields of a run that describe how the run was made, and are no results.
const NO_RESULTS: [&str; 9] = [
    "options",
    "paths",
    "integrator_options",
    "width",
    "height",
    "spp",
    "bounces",
    "seed",
    "shadow_resolution",
];

impl Campaign {
    /// Collects the campaign of these lines, in the order of their places; `None` if the first line belongs
    /// to no campaign.
    pub fn of<'a>(lines: impl IntoIterator<Item = &'a Report>) -> Option<Self> {
        let mut lines: Vec<_> = lines.into_iter().collect();
        lines.sort_by_key(|line| line.cell.as_ref().map(|cell| cell.place));
        let first = *lines.first()?;
        let title = first.cell.as_ref()?.campaign.as_ref()?.title.clone();
        let mut experiments: BTreeMap<u32, Experiment> = BTreeMap::new();
        for line in lines {
            let asked = line.cell.as_ref().and_then(|cell| cell.campaign.as_ref());
            for experiment in asked.into_iter().flat_map(|campaign| &campaign.experiments) {
                let empty = || Experiment { name: experiment.name.clone(), rows: Vec::new() };
                let row = Row::of(line, experiment);
                experiments.entry(experiment.place).or_insert_with(empty).rows.extend(row);
            }
        }
        let experiments = experiments.into_values().collect();
        Some(Self { title, program: first.program(), device: first.device.clone(), experiments })
    }
}

impl Experiment {
    /// Returns the names of all settings of the rows, in the order in which they are shown.
    pub fn settings(&self) -> Vec<&str> {
        in_order(self.rows.iter().flat_map(|row| row.settings.keys().map(String::as_str)))
    }

    /// Splits the experiment into its sets of rays and its images, and returns the parts that have rows. Each
    /// of the two has settings and results that the other does not have.
    pub fn parts(&self) -> Vec<Self> {
        let part = |rays: bool| {
            let rows = self.rows.iter().filter(|row| row.run().ray_set.is_some() == rays);
            Self { name: self.name.clone(), rows: rows.cloned().collect() }
        };
        [part(true), part(false)].into_iter().filter(|part| !part.rows.is_empty()).collect()
    }

    /// Returns the names of the settings in which rows differ. A row without a setting differs from a row
    /// that has it.
    pub fn varied(&self) -> Vec<&str> {
        let values = |name: &str| {
            self.rows.iter().map(|row| row.settings.get(name).map(String::as_str)).collect::<BTreeSet<_>>()
        };
        self.settings().into_iter().filter(|name| values(name).len() > 1).collect()
    }
}

/// Returns each name once, in the order in which settings are shown: options, in alphabetical order, stand
/// between the settings that every cell may have.
pub fn in_order<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let names: BTreeSet<_> = names.into_iter().collect();
    let of = |order: &'static [&'static str]| order.iter().copied().filter(|name| names.contains(name));
    let options = names.iter().copied().filter(|name| !BEFORE.contains(name) && !AFTER.contains(name));
    of(&BEFORE).chain(options).chain(of(&AFTER)).collect()
}

impl Row {
    /// Makes the row of a line in an experiment; `None` if the line is not a cell.
    fn of(line: &Report, experiment: &ExperimentRecord) -> Option<Self> {
        let record = line.cell.as_ref()?;
        let mut settings = cell_settings(&record.depends_on);
        let camera = line.camera.as_ref().map(|camera| ("camera".to_owned(), camera.name.clone()));
        settings.extend(camera);
        for (name, value) in experiment.settings.iter().filter(|(name, _)| !SEEN.contains(&name.as_str())) {
            settings.entry(name.clone()).or_insert_with(|| value.clone());
        }
        let run = line.runs.first()?;
        Some(Self { key: record.key.clone(), settings, results: results(run), report: line.clone() })
    }

    /// Returns the run.
    pub fn run(&self) -> &Run {
        &self.report.runs[0]
    }

    /// Returns the setting of a name; empty if the row does not have it.
    pub fn setting(&self, name: &str) -> &str {
        self.settings.get(name).map_or("", String::as_str)
    }
}

/// Returns the settings of a cell by the names of the command's options.
pub fn cell_settings(cell: &Cell) -> BTreeMap<String, String> {
    let mut settings = BTreeMap::new();
    let mut set = |name: &str, value: Option<String>| {
        settings.extend(value.map(|value| (name.to_owned(), value)));
    };
    set("scene", Some(cell.scene.clone()));
    set("time", cell.time_s.map(|time| time.to_string()));
    set("clip", (!cell.clips.is_empty()).then(|| cell.clips.join(" ")));
    if let Some(view) = &cell.view {
        set("size", Some(format!("{}x{}", view.size[0], view.size[1])));
        set("back-faces", Some(view.back_faces.clone()));
    }
    set("system", Some(cell.system.clone()));
    set("preset", Some(cell.preset.clone()));
    if let Some(rays) = &cell.rays {
        set("ray-set", Some(rays.set.clone()));
        set("rays", Some(rays.count.to_string()));
    }
    if let Some(image) = &cell.image {
        set("integrator", Some(image.integrator.clone()));
        image.options.iter().for_each(|(name, value)| set(name, Some(value.clone())));
        set("spp", Some(image.spp.to_string()));
        set("adaptive", image.adaptive.clone());
        set("sampler", Some(image.sampler.clone()));
        set("primary", Some(image.primary.clone()));
        set("occluder", Some(image.occluder.clone()));
        set("shadow-resolution", image.shadow_resolution.map(|texels| texels.to_string()));
        set("shadow-points", image.shadow_points.map(|points| points.to_string()));
    }
    cell.options.iter().for_each(|(name, value)| set(name, Some(value.clone())));
    set("seed", Some(cell.seed.to_string()));
    set("repetitions", Some(cell.repetitions.to_string()));
    settings
}

/// Collects every number of a run by its path in the report; elements of a list are named by their `label`,
/// `stage` or `cells_of`.
/// `rays_traced` is the number of rays of `trace_ms`. `error_share` is the share of missed, false and wrong
/// hits among the rays that were compared.
fn results(run: &Run) -> BTreeMap<String, f64> {
    let mut numbers = BTreeMap::new();
    if let Ok(Value::Object(fields)) = serde_json::to_value(run) {
        let results = fields.into_iter().filter(|(name, _)| !NO_RESULTS.contains(&name.as_str()));
        results.for_each(|(name, value)| collect(&name, &value, &mut numbers));
    }
    // The name `rays` is a setting already: the number of rays that were asked for.
    if let Some(traced) = numbers.remove("rays") {
        numbers.insert("rays_traced".to_owned(), traced);
    }
    if let Some(accuracy) = &run.accuracy {
        let wrong = accuracy.missed + accuracy.false_hits + accuracy.wrong_primitive.unwrap_or(0);
        let compared = accuracy.rays - accuracy.ambiguous.min(accuracy.rays);
        if compared > 0 {
            numbers.insert("error_share".to_owned(), wrong as f64 / compared as f64);
        }
    }
    numbers
}

fn collect(path: &str, value: &Value, numbers: &mut BTreeMap<String, f64>) {
    match value {
        Value::Number(number) => numbers.extend(number.as_f64().map(|number| (path.to_owned(), number))),
        Value::Object(fields) => {
            fields.iter().for_each(|(name, value)| collect(&format!("{path}.{name}"), value, numbers));
        }
        Value::Array(elements) => {
            for element in elements {
                // A pass has a stage too, but only its label tells it from other passes.
                let name = ["label", "stage", "cells_of"].iter().find_map(|name| element.get(name)?.as_str());
                name.into_iter().for_each(|name| collect(&format!("{path}.{name}"), element, numbers));
            }
        }
        _ => {}
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::{
        Accuracy, CampaignRecord, CellImage, CellRays, CellRecord, CellView, Counters, Memory, Origin,
        SceneRecord, Spread, StageTime, Times,
    };

    pub(crate) fn cell(system: &str, samples: Option<&str>, image: bool) -> Cell {
        let options = samples.map(|samples| ("samples".to_owned(), samples.to_owned()));
        let rays = CellRays { set: "camera".to_owned(), count: 100, content: None };
        let own = CellImage { integrator: "path".to_owned(), spp: 8, ..CellImage::default() };
        Cell {
            scene: "cornell".to_owned(),
            view: Some(CellView { size: [4, 3], ..CellView::default() }),
            system: system.to_owned(),
            preset: "robust".to_owned(),
            options: options.into_iter().collect(),
            rays: (!image).then_some(rays),
            image: image.then_some(own),
            seed: 1,
            repetitions: 2,
            ..Cell::default()
        }
    }

    pub(crate) fn line(place: u32, experiments: &[(u32, &str)], depends_on: Cell) -> Report {
        let accuracy = Accuracy { rays: 60, ambiguous: 10, missed: 4, false_hits: 1, ..Accuracy::default() };
        let spread = Spread { count: 1, min: 1.0, q1: 1.0, q3: 1.0, max: 1.0 };
        let run = Run {
            ray_set: depends_on.rays.as_ref().map(|rays| rays.set.clone()),
            times: Times { trace_ms: Some(2.5), ..Times::default() },
            stages: vec![StageTime { stage: "film".to_owned(), ms: 0.5, spread }],
            memory: Some(Memory { structure_bytes: Some(64), ..Memory::default() }),
            counters: Some(Counters { fragments: Some(9), ..Counters::default() }),
            accuracy: depends_on.rays.as_ref().map(|_| accuracy),
            spp: Some(8),
            ..Run::default()
        };
        let origin = Origin { version: "1".to_owned(), ..Origin::default() };
        let report = Report::new(origin, Device::default(), SceneRecord::default(), vec![run]);
        let experiments = experiments.iter().map(|(place, name)| ExperimentRecord {
            place: *place,
            name: (*name).to_owned(),
            settings: BTreeMap::from([("environment".to_owned(), format!("sky{place}.hdr"))]),
        });
        let campaign = CampaignRecord { title: "All".to_owned(), experiments: experiments.collect() };
        let cell = CellRecord { place, campaign: Some(campaign), depends_on, ..CellRecord::default() };
        Report { cell: Some(cell), ..report }
    }

    #[test]
    fn lines_are_rows_of_the_experiments_that_asked_for_them() {
        let lines = [
            line(2, &[(0, "first")], cell("mmrt", Some("50"), true)),
            line(0, &[(1, "second"), (0, "first")], cell("mmrt", Some("100"), false)),
            line(1, &[(0, "first")], cell("bvh", None, false)),
        ];
        let campaign = Campaign::of(&lines).expect("of a campaign");
        let names: Vec<_> =
            campaign.experiments.iter().map(|one| (one.name.as_str(), one.rows.len())).collect();
        assert_eq!((campaign.title.as_str(), names), ("All", vec![("first", 3), ("second", 1)]));
        let first = &campaign.experiments[0];
        let systems: Vec<_> = first.rows.iter().map(|row| row.setting("system")).collect();
        assert_eq!(systems, ["mmrt", "bvh", "mmrt"], "in the order of places");
        let varied = ["system", "integrator", "samples", "ray-set", "rays", "spp"];
        let other = ["sampler", "primary", "occluder"];
        let varied: Vec<_> = varied.into_iter().chain(other).collect();
        assert_eq!(first.varied(), varied);
        assert_eq!(campaign.experiments[1].varied(), Vec::<&str>::new());
        let parts = first.parts();
        let shape: Vec<_> = parts.iter().map(|part| (part.rows.len(), part.varied())).collect();
        assert_eq!(shape, [(2, vec!["system", "samples"]), (1, vec![])]);
        // A setting that the plan has and the cell does not have.
        assert_eq!(campaign.experiments[1].rows[0].setting("environment"), "sky1.hdr");
        assert_eq!(Campaign::of(&[Report { cell: None, ..lines[0].clone() }]), None);
    }

    #[test]
    fn results_are_the_numbers_of_a_run_and_no_settings() {
        let lines = [line(0, &[(0, "a")], cell("mmrt", None, false))];
        let campaign = Campaign::of(&lines).expect("of a campaign");
        let results = &campaign.experiments[0].rows[0].results;
        let of = |name: &str| results.get(name).copied();
        assert_eq!(
            (of("trace_ms"), of("stages.film.ms"), of("memory.structure_bytes")),
            (Some(2.5), Some(0.5), Some(64.0))
        );
        assert_eq!((of("counters.fragments"), of("error_share"), of("spp")), (Some(9.0), Some(0.1), None));
    }
}

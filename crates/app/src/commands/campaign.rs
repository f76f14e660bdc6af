//! Campaign: the comparisons of a plan, one after another, and the folder of their results.

use super::compare::note_resumed;
use super::hard;
use super::steps::{open_device, stop_if_requested, with_progress};
use super::subject::{ComparisonRequest, Subject};
use super::targets::Form;
use crate::arguments::{CampaignArguments, CompareArguments, comparison};
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::{Cells, Destination, encode_picture};
use crate::terminal;
use crate::version::origin;
use rasray_campaign::{ComparisonPlan, Exclusion, Plan, estimate};
use rasray_experiment::{
    Backend, CampaignCells, CompareJob, ExperimentCells, FinishedRun, OpenBackend, Progress, check_run,
};
use rasray_metrics::tone_map;
use rasray_report::{ExperimentRecord, Report, cell_settings, in_line, in_order};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// Campaign to make.
pub(super) struct Campaign<'a> {
    pub(super) plan: &'a Plan,
    /// Origin of the plan, for messages.
    pub(super) about: &'a str,
    pub(super) given: &'a CampaignArguments,
    /// Command line as it was typed.
    pub(super) line: &'a str,
}

/// Comparison of the plan, as words of `rasray compare`.
struct Worded<'a> {
    /// Place of the comparison's experiment.
    place: usize,
    plan: &'a ComparisonPlan,
    given: CompareArguments,
}

/// Comparison of the plan with its subject.
struct Planned<'a> {
    place: usize,
    plan: &'a ComparisonPlan,
    asked: ComparisonRequest<'a>,
}

/// Reads a plan.
///
/// # Errors
/// The file cannot be read or is not a plan.
pub(super) fn read_plan(path: &Path, small: bool) -> Result<Plan, AppError> {
    let text = std::fs::read_to_string(path)
        .map_err(|error| AppError::input(path, error, "name a plan in TOML, such as plan.toml"))?;
    Plan::read(&text, small).map_err(|error| AppError::input(path, &error, error.help()))
}

impl<'a> Campaign<'a> {
    /// Makes the missing cells, and the files of the folder from all cells. Returns the lines of all cells if
    /// all exist; none for a share and for a dry run.
    ///
    /// # Errors
    /// A comparison does not accept an option (the message names the experiment), a scene is faulty, the
    /// folder accepts no files, or a signal arrived.
    pub(super) fn make(
        &self,
        open: &mut OpenBackend<'_>,
        interrupt: &Interrupt,
    ) -> Result<Vec<Report>, AppError> {
        let worded = self.worded()?;
        let planned = worded.iter().map(|Worded { place, plan, given }| {
            let asked = ComparisonRequest::of(given).map_err(|error| error.about(&self.name(*place)))?;
            Ok(Planned { place: *place, plan, asked })
        });
        let planned = planned.collect::<Result<Vec<_>, AppError>>()?;
        // A dry run makes no folder.
        let file = match self.given.dry_run && !self.given.folder().is_dir() {
            true => None,
            false => Some(self.cells_file()?),
        };
        let mut backend = open_device(open, &self.given.device)?;
        stop_if_requested(interrupt)?;
        let campaign = self.cells(&planned, backend.as_ref(), interrupt)?;
        let program = (origin(self.line), backend.device());
        let resume = self.given.resume || self.given.dry_run;
        let mut cells = Cells::open(campaign.list().clone(), program, file.as_ref(), (resume, interrupt))?;
        let wanted = cells.missing(self.given.shard)?;
        if self.given.dry_run {
            return self.tell(&campaign, &cells, &wanted).map(|()| Vec::new());
        }
        note_resumed(&cells, wanted.len());
        let made = self.compare(&planned, &campaign, &wanted, backend.as_mut(), &mut cells, interrupt)?;
        cells.note();
        if made < wanted.len() {
            let (made, wanted) = (made, wanted.len());
            let folder = self.given.folder().display();
            return Err(AppError::interrupted(
                format!("stopped after {made} of {wanted} runs; {folder} holds them"),
                "run again with --resume",
            ));
        }
        let lines: Vec<_> = cells.lines().cloned().collect();
        lines.iter().flat_map(|line| &line.runs).try_for_each(check_run)?;
        if self.given.shard.is_some() {
            return Ok(Vec::new());
        }
        self.write(&lines, interrupt)?;
        Ok(lines)
    }

    /// Reads the words of each comparison.
    fn worded(&self) -> Result<Vec<Worded<'a>>, AppError> {
        let read = |(place, plan): (usize, &'a ComparisonPlan)| {
            let given = comparison(&plan.words);
            let given = given.and_then(|given| match hard::asked_for(&given.scene) {
                None => Ok(given),
                Some(_) => Err(AppError::usage(
                    "a plan has no hard cases",
                    "compare them by themselves: rasray compare hard:all",
                )),
            });
            let given = given.map_err(|error| error.about(&self.name(place)))?;
            Ok(Worded { place, plan, given })
        };
        self.plan.comparisons().map(read).collect()
    }

    /// Returns the name of the experiment at a place, for messages.
    fn name(&self, place: usize) -> String {
        format!("{}: experiment '{}'", self.about, self.plan.experiments[place].name)
    }

    /// Returns the file of the cells, in a folder that is made if it is missing.
    fn cells_file(&self) -> Result<Destination, AppError> {
        let folder = self.given.folder();
        std::fs::create_dir_all(folder)
            .map_err(|error| AppError::input(folder, error, "name a folder that can be made"))?;
        let name = match self.given.shard {
            None => "cells.jsonl".to_owned(),
            Some(shard) => format!("cells.{}.jsonl", shard.to_string().replace('/', "-of-")),
        };
        Destination::check(&folder.join(name))
    }

    /// Returns all cells of the campaign. Scenes are read, because their contents decide the cells' keys.
    fn cells(
        &self,
        planned: &[Planned<'_>],
        backend: &dyn Backend,
        interrupt: &Interrupt,
    ) -> Result<CampaignCells, AppError> {
        let mut comparisons = Vec::new();
        let mut unknown: BTreeMap<usize, BTreeSet<String>> = BTreeMap::new();
        let mut held = BTreeSet::new();
        for planned in planned {
            stop_if_requested(interrupt)?;
            let subject = self.subject(planned, backend)?;
            let cells = subject.cells();
            let experiment = &self.plan.experiments[planned.place];
            let unknown = unknown.entry(planned.place).or_insert_with(|| names(&experiment.exclusions));
            let mut excluded = BTreeSet::new();
            for (place, record) in (0..cells.len()).filter_map(|place| Some((place, cells.record(place)?))) {
                let mut settings = cell_settings(&record.depends_on);
                settings.extend(planned.plan.settings.clone());
                unknown.retain(|name| !settings.contains_key(name));
                for (number, exclusion) in experiment.exclusions.iter().enumerate() {
                    if exclusion.holds(&settings) {
                        excluded.insert(place);
                        held.insert((planned.place, number));
                    }
                }
            }
            let experiment = ExperimentRecord {
                place: planned.place as u32,
                name: experiment.name.clone(),
                settings: planned.plan.settings.clone(),
            };
            comparisons.push(ExperimentCells { experiment, cells, excluded });
        }
        if let Some((place, name)) =
            unknown.iter().find_map(|(place, names)| Some((*place, names.first()?.clone())))
        {
            return Err(AppError::usage(
                format!("{} excludes by '{name}', which none of its runs has", self.name(place)),
                "name a setting such as scene, system, preset, ray-set or an option that the experiment sets",
            ));
        }
        for (place, experiment) in self.plan.experiments.iter().enumerate() {
            let of_it = |one: &&ExperimentCells| one.experiment.place == place as u32;
            if comparisons.iter().filter(of_it).all(|one| one.excluded.len() == one.cells.len()) {
                return Err(AppError::usage(
                    format!("{} excludes all of its runs", self.name(place)),
                    "exclude less, or leave the experiment out",
                ));
            }
            for (number, exclusion) in experiment.exclusions.iter().enumerate() {
                if !held.contains(&(place, number)) {
                    terminal::warn(&format!("{} excludes {exclusion}, which no run is", self.name(place)));
                }
            }
        }
        Ok(CampaignCells::new(&self.plan.title, &comparisons))
    }

    fn subject<'b>(&self, planned: &Planned<'b>, backend: &dyn Backend) -> Result<Subject<'b>, AppError> {
        let read = || {
            let mut subject = planned.asked.clone().read()?;
            subject.fit(backend)?;
            Ok(subject)
        };
        read().map_err(|error: AppError| error.about(&self.name(planned.place)))
    }

    /// Makes the wanted cells, and returns how many were made.
    fn compare(
        &self,
        planned: &[Planned<'_>],
        campaign: &CampaignCells,
        wanted: &BTreeSet<usize>,
        backend: &mut dyn Backend,
        cells: &mut Cells,
        interrupt: &Interrupt,
    ) -> Result<usize, AppError> {
        let mut made = 0;
        let total = wanted.len() as u64;
        for (number, planned) in planned.iter().enumerate() {
            let own = campaign.made_by(number);
            let only: BTreeSet<_> =
                own.iter().filter(|(_, place)| wanted.contains(place)).map(|(own, _)| *own).collect();
            if only.is_empty() {
                continue;
            }
            if interrupt.requested() {
                break;
            }
            let subject = self.subject(planned, backend)?;
            let job = CompareJob { only: Some(only), ..subject.job() };
            let before = made;
            let mut failed = None;
            let size = [job.frame.width, job.frame.height];
            let mut finished = |FinishedRun { place, run, pixels }: FinishedRun<'_>| {
                let Some(place) = own.get(&place) else { return ControlFlow::Continue(()) };
                // A line claims that its picture exists, so the picture is written first.
                let kept = match (pixels, campaign.list().record(*place)) {
                    (Some(pixels), Some(record)) => self.keep_picture(pixels, size, &record.key, interrupt),
                    _ => Ok(()),
                };
                let added = kept.and_then(|()| cells.add(*place, run.clone(), subject.records(), interrupt));
                failed = added.err();
                made += 1;
                if failed.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            let name = &self.plan.experiments[planned.place].name;
            with_progress(
                interrupt,
                |progress| progress.done > 0,
                |progress| {
                    backend.compare(&job, &mut finished, &mut |own| {
                        let task = format!("{name}: {}", own.task);
                        let done = before as u64 + if own.unit == "runs" { own.done } else { 0 };
                        progress(Progress { task: &task, done, total, unit: "runs" })
                    })
                },
            )
            .map_err(|error| error.about(&self.name(planned.place)))?;
            if let Some(error) = failed {
                return Err(error);
            }
        }
        Ok(made)
    }

    /// Writes the picture of a run under the key of the run.
    fn keep_picture(
        &self,
        pixels: &[[f32; 3]],
        size: [u32; 2],
        key: &str,
        interrupt: &Interrupt,
    ) -> Result<(), AppError> {
        let place = picture_place(self.given.folder(), key);
        let folder = place.parent().unwrap_or(&place);
        std::fs::create_dir_all(folder)
            .map_err(|error| AppError::input(folder, error, "name a folder that can be made"))?;
        let bytes = encode_picture(&tone_map(pixels, 0.0), size)?;
        Destination::check(&place)?.put(&bytes, interrupt)
    }

    /// Tells which cells would be made, and how long they would take.
    fn tell(
        &self,
        campaign: &CampaignCells,
        cells: &Cells,
        wanted: &BTreeSet<usize>,
    ) -> Result<(), AppError> {
        let settings: Vec<_> = campaign.cells().map(cell_settings).collect();
        let names = in_order(settings.iter().flat_map(|own| own.keys().map(String::as_str)));
        // Images are compared with images, and sets of rays with sets of rays.
        let kind = |own: &BTreeMap<String, String>| own.contains_key("integrator");
        let differs = |one: &BTreeMap<String, String>, other: &BTreeMap<String, String>, name: &str| {
            let same_kind = kind(one) == kind(other) || ["ray-set", "integrator"].contains(&name);
            same_kind && one.get(name) != other.get(name)
        };
        let firsts = [true, false].map(|images| settings.iter().find(|own| kind(own) == images));
        let varies = |name: &&str| {
            settings.iter().any(|own| firsts.iter().flatten().any(|first| differs(own, first, name)))
        };
        let varied: Vec<_> = names.into_iter().filter(varies).collect();
        let mut text = String::new();
        for place in wanted {
            let own = &settings[*place];
            let words = varied.iter().filter_map(|name| match (*name, own.get(*name)?) {
                ("scene" | "system" | "preset" | "ray-set" | "integrator", value) => Some(value.clone()),
                (name, value) => Some(format!("{name}={value}")),
            });
            let asked = campaign.list().record(*place).and_then(|record| record.campaign.as_ref());
            let experiments = asked.into_iter().flat_map(|campaign| &campaign.experiments);
            let names = experiments.map(|experiment| experiment.name.as_str()).collect::<Vec<_>>().join("; ");
            let words = words.collect::<Vec<_>>().join(" ");
            text += &in_line(&format!("{place:>5}  {words}  [{names}]"));
            text.push('\n');
        }
        let depends = |place: &usize| campaign.list().record(*place).map(|record| &record.depends_on);
        let estimate = estimate(wanted.iter().filter_map(depends), cells.lines());
        text += &format!("{} runs of {}: {}\n", wanted.len(), campaign.list().len(), estimate);
        terminal::print(&text)
    }

    /// Writes the files that combine all cells.
    fn write(&self, lines: &[Report], interrupt: &Interrupt) -> Result<(), AppError> {
        let Some(campaign) = rasray_report::Campaign::of(lines) else { return Ok(()) };
        for (name, form) in
            [("table.csv", Form::Csv), ("report.md", Form::Markdown), ("report.html", Form::Page)]
        {
            let place = Destination::check(&self.given.folder().join(name))?;
            place.write(&form.of_campaign(&campaign)?, interrupt)?;
        }
        Ok(())
    }
}

/// Returns the file name of the picture of a run.
pub(super) fn picture_place(folder: &Path, key: &str) -> PathBuf {
    folder.join("pictures").join(format!("{key}.png"))
}

/// Returns the names of the settings that exclusions depend on.
fn names(exclusions: &[Exclusion]) -> BTreeSet<String> {
    exclusions.iter().flat_map(Exclusion::names).map(str::to_owned).collect()
}

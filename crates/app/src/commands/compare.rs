//! `rasray compare`.

use super::{
    check_whole, destination, hard, keep_inputs, open_device, read_scene, stop_if_requested, with_progress,
};
use crate::arguments::CompareArguments;
use crate::backend::{CompareJob, Comparison, OpenBackend, RaySet};
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::output::Destination;
use crate::output::{self, SaveTargets};
use crate::progress::during;
use crate::report::{Report, markdown, origin, table};
use crate::systems;
use crate::terminal::{self, Talk};
use crate::texels;
use rasray_ray_files::{load_hits, load_rays};
use rasray_report::json_shown;
use rasray_report_html::figures::Figures;
use std::ffi::OsStr;

/// Rays per set unless told.
const DEFAULT_RAYS: u32 = 200_000;

/// Sets of rays unless told.
const DEFAULT_SETS: [RaySet; 2] = [RaySet::Incoherent, RaySet::Camera];

/// Traces the same rays through several systems and reports speed next to error; `line` is the command
/// as it was typed.
///
/// # Errors
/// Everything that can be refused without a device is refused before a device is opened.
pub(crate) fn compare(
    given: &CompareArguments,
    line: &str,
    open: &mut OpenBackend<'_>,
    interrupt: &Interrupt,
) -> Result<(), AppError> {
    if let Some(id) = hard::asked_for(&given.scene) {
        return hard::compare(given, id, line, open, interrupt);
    }
    if given.full || given.check {
        let option = if given.full { "--full" } else { "--check" };
        return Err(AppError::usage(
            format!("{option} is an option of hard cases"),
            "leave it out, or name a hard case such as hard:E5",
        ));
    }
    let frame = given.frame.frame()?;
    let systems = systems::several(&given.systems, &given.presets, &given.structure, &given.assignments)?;
    let ray_sets = ray_sets(given)?;
    let targets = Targets::check(given, &given.scene)?;
    let rays_file = given.files.rays_file.as_deref().map(load_rays).transpose()?;
    let hits_files =
        given.files.hits_file.iter().map(|file| Ok::<_, AppError>(load_hits(&file.name, &file.path)?));
    let hits_files = hits_files.collect::<Result<Vec<_>, _>>()?;

    let (mut loaded, chosen) = read_scene(&given.scene, &given.reading, &given.view)?;
    let systems: Vec<_> =
        systems.into_iter().map(|system| system.seen_by(&chosen.camera, frame.width, frame.height)).collect();
    let shortcomings = systems.iter().filter_map(|system| system.shortcoming(frame.workload()));
    shortcomings.filter(|_| given.image).for_each(|text| terminal::warn(&text));

    let mut backend = open_device(open, &given.device)?;
    stop_if_requested(interrupt)?;
    let needs = given.reading.needs(&loaded.scene, frame.workload());
    during("scene", "fitting images", || texels::fit(&mut loaded, &needs, &backend.texel_room()))?;
    let sets = ray_sets.len() + usize::from(rays_file.is_some());
    let wanted = systems.len() * (sets + usize::from(given.image)) + hits_files.len();
    let job = CompareJob {
        scene: &loaded.scene,
        camera: chosen.camera.clone(),
        systems,
        ray_sets,
        rays: given.rays.unwrap_or(DEFAULT_RAYS),
        frame,
        image: given.image,
        figures: targets.html.is_some(),
        repetitions: given.repetitions,
        rays_file,
        hits_files,
        keep: targets.save.any(),
        replay: given.replay,
        needs,
    };
    let Comparison { runs, figures, kept, replay } =
        with_progress(interrupt, |progress| progress.done > 0, |progress| backend.compare(&job, progress))?;
    if let Some(text) = replay {
        return terminal::print(&text);
    }
    let finished = runs.len();
    if finished == 0 && interrupt.requested() {
        return Err(AppError::interrupted("stopped before the first run was whole; nothing was written", ""));
    }

    let report =
        Report::new(origin(line), backend.device(), loaded.record(), runs).seen_from(chosen.record());
    output::save(&targets.save, &kept, interrupt)?;
    targets.write(&report, &figures, interrupt)?;
    terminal::summarize(&table(&report, terminal::says(Talk::Verbose)), targets.take_stdout())?;
    report.runs.iter().try_for_each(check_whole)?;
    if finished < wanted && interrupt.requested() {
        let kept = if targets.any() { "the report holds them" } else { "no report was asked for" };
        return Err(AppError::interrupted(
            format!("stopped after {finished} of {wanted} runs; {kept}"),
            "run again for all of them",
        ));
    }
    Ok(())
}

/// Where results go.
pub(super) struct Targets {
    report: Option<Destination>,
    html: Option<Destination>,
    markdown: Option<Destination>,
    save: SaveTargets,
}

impl Targets {
    /// Checks every place before anything is begun.
    pub(super) fn check(given: &CompareArguments, scene: &OsStr) -> Result<Self, AppError> {
        let report = destination(given.report.as_deref())?;
        let html = destination(given.html.as_deref())?;
        let markdown = destination(given.markdown.as_deref())?;
        let named = [("--report", &report), ("--html", &html), ("--markdown", &markdown)];
        for (index, (option, place)) in named.iter().enumerate() {
            for (other, twin) in &named[..index] {
                if let (Some(place), Some(twin)) = (place, twin)
                    && place.same_as(twin)
                {
                    return Err(AppError::usage(
                        format!("{other} and {option} name the same file"),
                        "name two files",
                    ));
                }
            }
        }
        keep_inputs("--report", report.as_ref(), scene)?;
        keep_inputs("--html", html.as_ref(), scene)?;
        keep_inputs("--markdown", markdown.as_ref(), scene)?;
        let save = SaveTargets::check(given.files.save_rays.as_deref(), given.files.save_hits.as_deref())?;
        Ok(Self { report, html, markdown, save })
    }

    /// Whether a page is wanted, and with it figures.
    pub(super) fn has_page(&self) -> bool {
        self.html.is_some()
    }

    /// Whether a file goes to standard output, which then carries nothing else.
    pub(super) fn take_stdout(&self) -> bool {
        [&self.report, &self.html, &self.markdown].into_iter().flatten().any(Destination::is_stdout)
    }

    /// Where rays and hits go.
    pub(super) fn save(&self) -> &SaveTargets {
        &self.save
    }

    /// Whether a file keeps the runs.
    fn any(&self) -> bool {
        self.report.is_some() || self.html.is_some() || self.markdown.is_some()
    }

    /// Writes the report and the page where they are wanted.
    pub(super) fn write(
        &self,
        report: &Report,
        figures: &Figures,
        interrupt: &Interrupt,
    ) -> Result<(), AppError> {
        if let Some(place) = &self.report {
            place.write(json_shown(&report.to_json()).as_bytes(), interrupt)?;
        }
        if let Some(place) = &self.markdown {
            place.write(markdown(report).as_bytes(), interrupt)?;
        }
        if let Some(place) = &self.html {
            let page = rasray_report_html::page(report, figures).map_err(|error| {
                let help =
                    "the page was not written; this is a defect, please report it with the command line";
                AppError::refused(error.to_string(), help)
            })?;
            place.write(&page, interrupt)?;
        }
        Ok(())
    }
}

/// The generated sets that are wanted, each once, in the order given.
fn ray_sets(given: &CompareArguments) -> Result<Vec<RaySet>, AppError> {
    let mut kept = Vec::new();
    for set in &given.ray_set {
        if !kept.contains(set) {
            kept.push(*set);
        }
    }
    let from_file = given.files.rays_file.is_some();
    if kept.is_empty() && !from_file {
        kept.extend(DEFAULT_SETS);
    }
    if !given.files.hits_file.is_empty() && kept.len() + usize::from(from_file) != 1 {
        return Err(AppError::usage(
            "--hits-file has the hits of one set of rays, and several are traced",
            "say which with one --ray-set or with --rays-file",
        ));
    }
    Ok(kept)
}

//! Subject of a comparison: the request of its options, and the scene.

use super::steps::{Posing, Shown, fit_images, read_scene};
use crate::arguments::CompareArguments;
use crate::error::AppError;
use crate::hints::with_flags;
use crate::terminal;
use crate::version::version_text;
use rasray_experiment::{
    AovSelection, Backend, CellList, CompareJob, Frame, FrameDefaults, RaySet, SystemConfig, compare_cells,
    count_not_uploaded,
};
use rasray_ray_files::{HitsFile, RaysFile, load_hits, load_rays};
use rasray_report::{CameraRecord, SceneRecord};
use rasray_scene::needs::Needs;
use rasray_scene_source::{ChosenCamera, LoadedScene};

/// Default number of rays per set.
const DEFAULT_RAYS: u32 = 200_000;

/// Default sets of rays.
const DEFAULT_SETS: [RaySet; 2] = [RaySet::Incoherent, RaySet::Camera];

/// Request of a comparison, checked as far as possible without the scene.
#[derive(Clone)]
pub(super) struct ComparisonRequest<'a> {
    given: &'a CompareArguments,
    frame: Frame,
    systems: Vec<SystemConfig>,
    ray_sets: Vec<RaySet>,
    rays_file: Option<RaysFile>,
    hits_files: Vec<HitsFile>,
}

/// Subject of a comparison whose scene is read.
pub(super) struct Subject<'a> {
    asked: ComparisonRequest<'a>,
    loaded: LoadedScene,
    chosen: ChosenCamera,
    needs: Needs,
}

impl<'a> ComparisonRequest<'a> {
    /// # Errors
    /// An option belongs to hard cases, systems do not have it, or a file cannot be read.
    pub(super) fn of(given: &'a CompareArguments) -> Result<Self, AppError> {
        if given.full || given.check {
            let option = if given.full { "--full" } else { "--check" };
            return Err(AppError::usage(
                format!("{option} is an option of hard cases"),
                "leave it out, or name a hard case such as hard:E5",
            ));
        }
        let frame = given.work.frame(FrameDefaults::default(), true)?;
        let systems = given.systems()?;
        let ray_sets = ray_sets(given)?;
        let rays_file = given.files.rays_file.as_deref().map(load_rays).transpose()?;
        let hits_files =
            given.files.hits_file.iter().map(|file| Ok::<_, AppError>(load_hits(&file.name, &file.path)?));
        let hits_files = hits_files.collect::<Result<_, _>>()?;
        Ok(Self { given, frame, systems, ray_sets, rays_file, hits_files })
    }

    /// Reads the scene of the comparison.
    ///
    /// # Errors
    /// The scene cannot be read, or does not have the requested parts.
    pub(super) fn read(mut self) -> Result<Subject<'a>, AppError> {
        let work = &self.given.work;
        let shown =
            work.reading.time.map(|seconds| Shown { seconds, posing: Posing::Host, times: Vec::new() });
        let (loaded, chosen) = read_scene(&self.given.scene, &work.reading, shown.as_ref(), &work.view)?;
        self.systems =
            self.systems.into_iter().map(|system| system.seen_by(&chosen.camera, &self.frame)).collect();
        let needs = work.reading.needs(&loaded.scene, self.frame.workload(), AovSelection::default());
        Ok(Subject { asked: self, loaded, chosen, needs })
    }
}

impl Subject<'_> {
    /// Warns of parts of the image that systems cannot show.
    pub(super) fn warn(&self) {
        let ComparisonRequest { systems, frame, given, .. } = &self.asked;
        let shortcomings = systems.iter().filter_map(|system| system.shortcoming(frame.workload()));
        shortcomings.filter(|_| given.image).for_each(|text| terminal::warn(&with_flags(&text)));
    }

    /// Makes images of the scene smaller if the device cannot hold them.
    pub(super) fn fit(&mut self, backend: &dyn Backend) -> Result<(), AppError> {
        fit_images(&mut self.loaded, &self.needs, backend)?;
        count_not_uploaded(&mut self.loaded, &self.chosen.camera, &self.needs);
        Ok(())
    }

    /// Makes the job of all its cells, which keeps only its runs.
    pub(super) fn job(&self) -> CompareJob<'_> {
        let ComparisonRequest { given, frame, systems, ray_sets, rays_file, hits_files } = &self.asked;
        CompareJob {
            scene: &self.loaded.scene,
            camera: self.chosen.camera.clone(),
            systems: systems.clone(),
            ray_sets: ray_sets.clone(),
            rays: given.rays.unwrap_or(DEFAULT_RAYS),
            frame: frame.clone(),
            image: given.image,
            figures: false,
            lists: given.statistics,
            repetitions: given.repetitions,
            rays_file: rays_file.clone(),
            hits_files: hits_files.clone(),
            keep: false,
            replay: given.replay,
            needs: self.needs.clone(),
            only: None,
        }
    }

    /// Returns the cells of the comparison.
    pub(super) fn cells(&self) -> CellList {
        compare_cells(version_text(), &self.loaded, &self.job())
    }

    /// Returns the records of the scene and of the camera for a report.
    pub(super) fn records(&self) -> (SceneRecord, Option<CameraRecord>) {
        (self.loaded.record(), Some(self.chosen.record()))
    }

    /// Describes the camera in words.
    pub(super) fn camera(&self) -> String {
        self.chosen.described()
    }
}

/// Returns the generated sets that are wanted, each once, in the order given.
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

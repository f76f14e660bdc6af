//! Comparison of systems: equal rays and images, alternated in one process, against the truth.

use std::ops::ControlFlow;

use rasray_ads::Ray;
use rasray_gpu::Device;
use rasray_reference::oracle::{Accept, Oracle, Side};
use rasray_reference::shading::{PosedScene, View};

use crate::backend::{FinishedRun, OnProgress, OnRun, Progress};
use crate::contestant::Contestant;
use crate::device_scene::DeviceScene;
use crate::error::ExperimentError;
use crate::images::compare_images;
use crate::jobs::{CompareJob, Comparison, FILE_SET};
use crate::rays::{RayFlags, RaySource, oracle_ray, triangles};
use crate::replay::{ReplaySetting, replay_sets};
use crate::traced_set::{RaysWithTruth, Taking, Wanted, compare_set};
use crate::work_maps::work_maps;

/// Inputs of a comparison.
#[derive(Clone, Copy)]
pub(super) struct Setting<'a> {
    pub(super) device: &'a Device,
    pub(super) job: &'a CompareJob<'a>,
    pub(super) stage: &'a DeviceScene,
    pub(super) posed: &'a PosedScene<'a>,
    pub(super) view: &'a View,
}

impl CompareJob<'_> {
    /// True if the cell at a place is wanted.
    pub(super) fn wants(&self, place: usize) -> bool {
        self.only.as_ref().is_none_or(|only| only.contains(&place))
    }

    /// Returns the number of cells of each set of rays.
    fn cells_of_set(&self) -> usize {
        self.systems.len() + self.hits_files.len()
    }

    /// Returns the number of sets of rays.
    fn sets(&self) -> usize {
        self.ray_sets.len() + usize::from(self.rays_file.is_some())
    }

    /// Returns the place of the first image.
    pub(super) fn first_image(&self) -> usize {
        self.sets() * self.cells_of_set()
    }

    /// Returns the number of wanted cells.
    fn wanted(&self) -> usize {
        let images = if self.image { self.systems.len() + 1 } else { 0 };
        (0..self.first_image() + images).filter(|place| self.wants(*place)).count()
    }

    /// Returns the name and the rays of a set.
    fn rays_of(&self, set: usize, source: &RaySource<'_>) -> (String, Vec<Ray>) {
        match (self.ray_sets.get(set), &self.rays_file) {
            (Some(set), _) => (set.name().to_owned(), source.rays(*set, self.rays)),
            (None, Some(file)) => (FILE_SET.to_owned(), file.relative_to(source.frame_origin.to_array())),
            (None, None) => (String::new(), Vec::new()),
        }
    }
}

/// Runs all systems on all ray sets, then on the image if that is wanted.
pub(super) fn compare(
    device: &Device,
    job: &CompareJob<'_>,
    finished: &mut OnRun<'_>,
    progress: &mut OnProgress<'_>,
) -> Result<Comparison, ExperimentError> {
    let frame = &job.frame;
    _ = progress(Progress { task: "scene", done: 0, total: 0, unit: "to the device" });
    let mut stage = DeviceScene::new(
        device,
        job.scene,
        &job.camera,
        [frame.width, frame.height],
        frame.seed,
        &job.needs,
    )?;
    stage.sample_as(frame)?;
    let (positions, indices) = stage.triangles(device)?;
    let posed = PosedScene::with_positions(job.scene, stage.scene.frame_origin(), positions.clone())?
        .with_back_faces(frame.back_faces);
    let view = View {
        camera: job.camera.clone(),
        width: frame.width,
        height: frame.height,
        samples: frame.spp,
        seed: frame.seed,
        sampler: frame.sampler,
    };
    let setting = Setting { device, job, stage: &stage, posed: &posed, view: &view };
    let mut comparison = Comparison::default();
    if job.replay.is_some() || (0..job.first_image()).any(|place| job.wants(place)) {
        let end = compare_rays(&setting, (&positions, &indices), &mut comparison, finished, progress)?;
        if end.is_break() {
            return Ok(comparison);
        }
    }
    if job.image && job.replay.is_none() {
        compare_images(&setting, &mut comparison, finished, progress)?;
    }
    Ok(comparison)
}

/// Runs all systems on all ray sets of which a cell is wanted. Only these sets are drawn and answered by the
/// oracle.
fn compare_rays(
    setting: &Setting<'_>,
    (positions, indices): (&[[f32; 3]], &[u32]),
    comparison: &mut Comparison,
    finished: &mut OnRun<'_>,
    progress: &mut OnProgress<'_>,
) -> Result<ControlFlow<()>, ExperimentError> {
    let Setting { device, job, stage, posed, view } = *setting;
    let accept = |primitive: u32, barycentrics: [f64; 2]| posed.alpha_accepts(primitive, barycentrics);
    _ = progress(Progress { task: "oracle", done: 0, total: 0, unit: "building" });
    let masked = posed.has_alpha_masks() && stage.dropped_triangles == 0;
    let accept: Option<Accept<'_>> = if masked { Some(&accept) } else { None };
    let oracle = Oracle::new(positions, indices, accept)?;
    let oracle = oracle.with_backs(|primitive| posed.back_of(primitive));
    let bounds = stage.scene.geometry().bounds();
    let center = views_center(stage, bounds);
    let source = RaySource {
        view,
        frame_origin: stage.scene.frame_origin(),
        bounds,
        center,
        oracle: &oracle,
        positions,
        indices,
        flags: RayFlags::of(&stage.scene),
    };
    if let Some(index) = job.replay {
        let setting = ReplaySetting { device, stage, oracle: &oracle, center };
        let sets = (0..job.sets()).map(|set| job.rays_of(set, &source));
        *comparison = replay_sets(&setting, &job.systems, sets, index)?;
        return Ok(ControlFlow::Break(()));
    }
    let places = job.cells_of_set();
    let takes_part = |position| (0..job.sets()).any(|set| job.wants(set * places + position));
    let around = (center, job.repetitions);
    let Some(mut contestants) = Contestant::some(device, stage, &job.systems, takes_part, around, progress)?
    else {
        return Ok(ControlFlow::Break(()));
    };
    if job.lists {
        for (_, contestant) in &mut contestants {
            contestant.lists = contestant.built.lists(device)?;
        }
    }
    if job.keep {
        comparison.kept.frame_origin = source.frame_origin.to_array();
        comparison.kept.triangles = triangles(positions, indices);
        let back = |primitive| match posed.back_of(primitive) {
            None => 0,
            Some(Side::Clockwise) => 1,
            Some(Side::CounterClockwise) => 2,
        };
        comparison.kept.backs = (0..posed.triangle_count()).map(back).collect();
    }
    let wanted =
        Wanted { repetitions: job.repetitions, seed: job.frame.seed, figures: job.figures, keep: job.keep };
    let total = job.wanted() as u64;
    for set in 0..job.sets() {
        let systems = (&mut contestants[..], job.systems.len());
        let mut taking = Taking::of(set * places, systems, &job.hits_files, |place| job.wants(place));
        if taking.is_empty() {
            continue;
        }
        let (name, rays) = job.rays_of(set, &source);
        let done = comparison.runs.len();
        if progress(Progress { task: &name, done: done as u64, total, unit: "runs" }).is_break() {
            return Ok(ControlFlow::Break(()));
        }
        let verdicts = oracle.closest_batch(&rays.iter().map(oracle_ray).collect::<Vec<_>>());
        let set = RaysWithTruth { name, rays, verdicts };
        compare_set(device, &mut taking, &set, wanted, |hits| hits, comparison)?;
        for (place, run) in comparison.places.iter().zip(&comparison.runs).skip(done) {
            if finished(FinishedRun { place: *place, run, pixels: None }).is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
        let done = comparison.runs.len() as u64;
        if progress(Progress { task: &set.name, done, total, unit: "runs" }).is_break() {
            return Ok(ControlFlow::Break(()));
        }
    }
    if job.figures {
        comparison.figures.work = work_maps(device, stage, &contestants, &source, &comparison.runs)?;
    }
    Ok(ControlFlow::Continue(()))
}

/// Returns the views' centre for ray sets: a tenth of the way from the camera to the middle of the scene, so
/// that the camera's rays do not start at the centre of the views.
fn views_center(stage: &DeviceScene, [lower, upper]: [[f32; 3]; 2]) -> [f32; 3] {
    let eye = stage.scene.eye();
    std::array::from_fn(|axis| {
        let middle = 0.5 * (f64::from(lower[axis]) + f64::from(upper[axis]));
        (f64::from(eye[axis]) + 0.1 * (middle - f64::from(eye[axis]))) as f32
    })
}

//! Jobs and their results as plain data.

pub use crate::aov::{Aov, AovImage, AovSelection};
pub use crate::frame::{Frame, OccluderKind, Primary, Refresh};
pub use crate::motion::FrameBefore;
use crate::shard::Shard;
use crate::system_config::SystemConfig;
use rasray_ads::{Hit, Ray, StructureKind};
use rasray_hard_cases::HardCase;
use rasray_ray_files::{HitsFile, RaysFile, TrueHit};
use rasray_report::figures::Figures;
use rasray_report::{AdaptiveRecord, Counters, Memory, Pass, Run, Spread, StageTime, Times};
use rasray_scene::needs::Needs;
use rasray_scene::{Camera, Moment, Scene};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Job that renders one image through one system.
#[derive(Clone, Debug)]
pub struct RenderJob<'a> {
    /// Scene to render; lit, and possibly without triangles.
    pub scene: &'a Scene,
    /// Moment at which the scene is shown, if the scene is at rest and the device poses it; absent if the
    /// scene is already posed.
    pub moment: Option<&'a Moment>,
    /// Camera from which the scene is seen.
    pub camera: Camera,
    /// System with its structure.
    pub system: SystemConfig,
    /// Parts of the structure that the image builds.
    pub refresh: Refresh,
    /// Image to render.
    pub frame: Frame,
    /// Share of the samples to make; absent for all.
    pub shard: Option<Shard>,
    /// Additional images that are wanted.
    pub aovs: AovSelection,
    /// Frame before, if the device poses the scene; needed for [`Aov::Motion`].
    pub before: Option<FrameBefore>,
    /// Data that is uploaded, compiled in and stored; everything with `--needs all`.
    pub needs: Needs,
    /// Number of builds that are timed after the first; with 0, [`Times::build_ms`] is absent.
    pub repetitions: u32,
}

/// Source of the rays of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RaySet {
    /// Random rays: origins uniform in the scene's box, directions uniform.
    Incoherent,
    /// Camera rays; the camera is not at the views' centre.
    Camera,
    /// Rays from the views' centre.
    Eye,
    /// Diffuse directions from the surfaces that the camera sees.
    Bounce,
    /// Mirrored directions from the surfaces that the camera sees.
    Specular,
    /// Directions around the mirrored ones, as from a polished surface.
    Glossy,
    /// Rays from surfaces: origins uniform on the triangles, which are not excluded, directions uniform.
    Surface,
    /// Segments of random lines, each inside one pixel of the camera at the views' centre.
    Pixel,
}

impl RaySet {
    /// All sets.
    pub const ALL: [Self; 8] = [
        Self::Incoherent,
        Self::Camera,
        Self::Eye,
        Self::Bounce,
        Self::Specular,
        Self::Glossy,
        Self::Surface,
        Self::Pixel,
    ];

    /// Returns the name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Incoherent => "incoherent",
            Self::Camera => "camera",
            Self::Eye => "eye",
            Self::Bounce => "bounce",
            Self::Specular => "specular",
            Self::Glossy => "glossy",
            Self::Surface => "surface",
            Self::Pixel => "pixel",
        }
    }

    /// Returns the description, one line of help.
    pub fn doc(self) -> &'static str {
        match self {
            Self::Incoherent => "Origins uniform in the scene's box, directions uniform",
            Self::Camera => "The camera's rays; the camera is not at the views' centre",
            Self::Eye => "From the views' centre",
            Self::Bounce => "Diffuse directions from what the camera sees",
            Self::Specular => "Mirrored directions from what the camera sees",
            Self::Glossy => "Directions around these, as of a polished surface",
            Self::Surface => "Origins uniform on the triangles, which are not excluded, directions uniform",
            Self::Pixel => "Pieces of random lines, each inside one pixel of the camera at the views' centre",
        }
    }
}

/// Job that compares systems on a scene.
#[derive(Clone, Debug)]
pub struct CompareJob<'a> {
    /// Scene to trace; lit, and possibly without triangles.
    pub scene: &'a Scene,
    /// Camera for the ray sets `camera` and `bounce` and for images.
    pub camera: Camera,
    /// Configurations, one per system and preset.
    pub systems: Vec<SystemConfig>,
    /// Ray sets, each of which makes a run with each system.
    pub ray_sets: Vec<RaySet>,
    /// Number of rays per set, at least 1.
    pub rays: u32,
    /// Frame that gives size, seed and integrator; the size also shapes the camera's rays.
    pub frame: Frame,
    /// True to compare an image of each system with the reference, too.
    pub image: bool,
    /// True to keep pictures and maps for a page.
    pub figures: bool,
    /// True to count the contents of each structure's lists, which reads its pools back.
    pub lists: bool,
    /// Number of timed repetitions of every build and every set, at least 1, after one that warms up.
    pub repetitions: u32,
    /// Rays from a file, which another program may have made: one more set, named [`FILE_SET`].
    pub rays_file: Option<RaysFile>,
    /// Hits found elsewhere, one for each ray of the only set.
    pub hits_files: Vec<HitsFile>,
    /// True to keep rays, truth and hits for files.
    pub keep: bool,
    /// Index of the ray of each set, from 0, that is replayed step by step instead of a comparison.
    pub replay: Option<u32>,
    /// Data that is uploaded, compiled in and stored; everything with `--needs all`.
    pub needs: Needs,
    /// Places of the cells to make, in the list of [`compare_cells`](crate::compare_cells); absent for all.
    pub only: Option<BTreeSet<usize>>,
}

/// Job that compares systems on a hard case.
#[derive(Clone, Debug)]
pub struct HardJob<'a> {
    /// Hard case: triangles, rays, eye and the known facts about the answers.
    pub case: &'a HardCase,
    /// Configurations, one per system and preset.
    pub systems: &'a [SystemConfig],
    /// Number of timed repetitions of every build and of the rays, at least 1, after one that warms up.
    pub repetitions: u32,
    /// Seed that the case's rays were drawn with.
    pub seed: u32,
    /// True to keep figures for a page.
    pub figures: bool,
    /// Hits found elsewhere, one for each ray.
    pub hits_files: &'a [HitsFile],
    /// True to keep rays, truth and hits for files.
    pub keep: bool,
    /// Index of the ray, from 0, that is replayed step by step instead of a comparison.
    pub replay: Option<u32>,
    /// Places of the cells to make: the systems in their order, then the files of hits; absent for all.
    pub only: Option<BTreeSet<usize>>,
}

/// Result of a comparison.
#[derive(Clone, Debug, Default)]
pub struct Comparison {
    /// Runs, one per system, preset and ray set, and per image where wanted.
    pub runs: Vec<Run>,
    /// Place of the cell of each run, see [`CompareJob::only`].
    pub places: Vec<usize>,
    /// Pictures and maps; empty unless [`CompareJob::figures`] asked for them.
    pub figures: Figures,
    /// Rays and answers; empty unless [`CompareJob::keep`] asked for them.
    pub kept: SavedRays,
    /// Replay of one ray in words, if [`CompareJob::replay`] asked for it.
    pub replay: Option<String>,
}

impl Comparison {
    /// Adds the run of a cell.
    pub(crate) fn add(&mut self, place: usize, run: Run) {
        self.places.push(place);
        self.runs.push(run);
    }
}

/// Name of the ray set from a file.
pub const FILE_SET: &str = "file";

/// Rays that were traced, and their answers.
#[derive(Clone, Debug, Default)]
pub struct SavedRays {
    /// Name of the hard case; absent for a scene.
    pub case: Option<String>,
    /// Frame origin in the world, metres; rays and triangles are relative to it.
    pub frame_origin: [f64; 3],
    /// Corners by global triangle id, metres.
    pub triangles: Vec<[[f32; 3]; 3]>,
    /// Backs by global triangle id: 0 without a back, 1 if rays may pass the clockwise side, 2 if they may
    /// pass the counter-clockwise side. Empty for a hard case.
    pub backs: Vec<u32>,
    /// Ray sets with their answers.
    pub sets: Vec<SavedSet>,
}

/// Ray set with all answers to it.
#[derive(Clone, Debug)]
pub struct SavedSet {
    /// Name of the set, such as `camera`.
    pub name: String,
    /// Rays as they were traced.
    pub rays: Vec<Ray>,
    /// Answers of the oracle, one per ray.
    pub truth: Vec<TrueHit>,
    /// Answers of the systems.
    pub answers: Vec<Answers>,
}

/// Answers of a system to a ray set.
#[derive(Clone, Debug)]
pub struct Answers {
    /// System and preset, such as `mmrt-robust`; for a system that takes part with several values of options
    /// also these, such as `bvh-robust.leaf=2,children=4`.
    pub name: String,
    /// Kind of structure, which tells whether a hit's `a` and `b` are weights of vertices.
    pub kind: StructureKind,
    /// Hits, one per ray.
    pub hits: Vec<Hit>,
}

/// Sums of samples, one entry per pixel, rows from the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilmSums {
    /// Sums of samples in linear Rec. 709, W/(sr m^2).
    pub sums: Vec<[f32; 3]>,
    /// Number of samples in each sum: those that were made and are finite.
    pub counts: Vec<u32>,
}

/// Result of a render. Its images have `width * height` pixels, rows from the top.
#[derive(Clone, Debug, Default)]
pub struct RenderOutput {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Mean over the samples done, the colour image; linear Rec. 709, W/(sr m^2).
    pub beauty: Vec<[f32; 3]>,
    /// Sums of these samples, if [`RenderJob::shard`] asked for a share.
    pub sums: Option<FilmSums>,
    /// Additional images that [`RenderJob::aovs`] asked for.
    pub aovs: BTreeMap<Aov, AovImage>,
    /// Number of samples per pixel in `beauty`, for adaptive samples the most that a pixel could get; less
    /// than asked for after an early end.
    pub samples_done: u32,
    /// Adaptive sampling, if some pixels got more samples than others.
    pub adaptive: Option<AdaptiveRecord>,
    /// Options of the structure as resolved from preset and command line.
    pub options: BTreeMap<String, Value>,
    /// Choices that depend on the device: builder, coverage, atomics.
    pub paths: BTreeMap<String, String>,
    /// Times of each stage, in the order of a frame.
    pub stages: Vec<StageTime>,
    /// Times of each pass.
    pub passes: Vec<Pass>,
    /// Times of the figures, and the ray rate.
    pub times: Times,
    /// Spread of repeated times, by the name of their median.
    pub spread: BTreeMap<String, Spread>,
    /// Memory of the render, bytes.
    pub memory: Option<Memory>,
    /// Counts that do not depend on the machine.
    pub counters: Option<Counters>,
}

impl RenderOutput {
    /// Makes the record of the render for a report.
    pub fn run(&self, system: &SystemConfig, frame: &Frame) -> Run {
        let mut run = Run {
            system: system.system.name.to_owned(),
            structure: system.system.structure.to_owned(),
            preset: system.preset.name().to_owned(),
            chosen: system.chosen.clone(),
            options: self.options.clone(),
            paths: self.paths.clone(),
            times: self.times,
            spread: self.spread.clone(),
            stages: self.stages.clone(),
            passes: self.passes.clone(),
            memory: self.memory.clone(),
            counters: self.counters.clone(),
            ..Run::default()
        };
        frame.describe(&mut run);
        run.spp = Some(self.samples_done);
        run.adaptive = self.adaptive;
        run
    }
}

//! Jobs and results as plain data.

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

/// One image of one system.
#[derive(Clone, Debug)]
pub struct RenderJob<'a> {
    /// The scene to render; lit, and possibly without triangles.
    pub scene: &'a Scene,
    /// When it is shown, where the scene is at rest: the device poses it. Absent: as it is.
    pub moment: Option<&'a Moment>,
    /// From where.
    pub camera: Camera,
    /// Through which structure.
    pub system: SystemConfig,
    /// Parts of its structure that the image builds.
    pub refresh: Refresh,
    /// The image.
    pub frame: Frame,
    /// Its samples to make; absent: all.
    pub shard: Option<Shard>,
    /// Images wanted in addition.
    pub aovs: AovSelection,
    /// The frame before, where the device poses the scene; for [`Aov::Motion`], which is not there without.
    pub before: Option<FrameBefore>,
    /// Data that is uploaded, compiled in and stored; everything with `--needs all`.
    pub needs: Needs,
    /// Builds that are timed after the first; with none there is no [`Times::build_ms`].
    pub repetitions: u32,
}

/// Source of the rays of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RaySet {
    /// Origins uniform in the scene's box, directions uniform.
    Incoherent,
    /// The camera's rays; the camera is not at the views' centre.
    Camera,
    /// From the views' centre.
    Eye,
    /// Diffuse directions from what the camera sees.
    Bounce,
    /// Mirrored directions from there.
    Specular,
    /// Directions around these, as of a polished surface.
    Glossy,
    /// Origins uniform on the triangles, which are not excluded, directions uniform.
    Surface,
    /// Pieces of random lines, each inside one pixel of the camera at the views' centre.
    Pixel,
}

impl RaySet {
    /// All of them.
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

    /// Its name on the command line and in reports.
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

    /// Description, one line of help.
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

/// Systems side by side.
#[derive(Clone, Debug)]
pub struct CompareJob<'a> {
    /// The scene to trace; lit, and possibly without triangles.
    pub scene: &'a Scene,
    /// For the ray sets `camera` and `bounce` and for images.
    pub camera: Camera,
    /// One entry per system and preset.
    pub systems: Vec<SystemConfig>,
    /// Each makes a run with each system.
    pub ray_sets: Vec<RaySet>,
    /// Rays per set, at least 1.
    pub rays: u32,
    /// Size, seed and integrator; the size also shapes the camera's rays.
    pub frame: Frame,
    /// True to compare an image of each system with the reference as well.
    pub image: bool,
    /// True to keep pictures and maps for a page.
    pub figures: bool,
    /// True to count the contents of each structure's lists, which reads its pools back.
    pub lists: bool,
    /// Timed repetitions of every build and every set, at least 1, after one that warms up.
    pub repetitions: u32,
    /// Rays that another program may have made: one more set, named [`FILE_SET`].
    pub rays_file: Option<RaysFile>,
    /// Hits found elsewhere, one for each ray of the only set.
    pub hits_files: Vec<HitsFile>,
    /// True to keep rays, truth and hits for files.
    pub keep: bool,
    /// Instead of comparing: the ray of each set that is replayed step by step, counted from 0.
    pub replay: Option<u32>,
    /// Data that is uploaded, compiled in and stored; everything with `--needs all`.
    pub needs: Needs,
    /// Places of the cells that are made, in the list of [`compare_cells`](crate::compare_cells); absent:
    /// all.
    pub only: Option<BTreeSet<usize>>,
}

/// Systems side by side on a hard case.
#[derive(Clone, Debug)]
pub struct HardJob<'a> {
    /// Triangles, rays, eye and what is known of the answers.
    pub case: &'a HardCase,
    /// One entry per system and preset.
    pub systems: &'a [SystemConfig],
    /// Timed repetitions of every build and of the rays, at least 1, after one that warms up.
    pub repetitions: u32,
    /// Seed that the case's rays were drawn with.
    pub seed: u32,
    /// True to keep figures for a page.
    pub figures: bool,
    /// Hits found elsewhere, one for each ray.
    pub hits_files: &'a [HitsFile],
    /// True to keep rays, truth and hits for files.
    pub keep: bool,
    /// Instead of comparing: the ray that is replayed step by step, counted from 0.
    pub replay: Option<u32>,
    /// Places of the cells that are made: the systems in their order, then the files of hits; absent: all.
    pub only: Option<BTreeSet<usize>>,
}

/// Result of a comparison.
#[derive(Clone, Debug, Default)]
pub struct Comparison {
    /// A run per system, preset and ray set, and per image where wanted.
    pub runs: Vec<Run>,
    /// The place of the cell of each run: see [`CompareJob::only`].
    pub places: Vec<usize>,
    /// Pictures and maps; empty unless [`CompareJob::figures`] asked for them.
    pub figures: Figures,
    /// Rays and answers; empty unless [`CompareJob::keep`] asked for them.
    pub kept: SavedRays,
    /// The replay of one ray in words, where [`CompareJob::replay`] asked for it.
    pub replay: Option<String>,
}

impl Comparison {
    /// Adds the run of a cell.
    pub(crate) fn add(&mut self, place: usize, run: Run) {
        self.places.push(place);
        self.runs.push(run);
    }
}

/// The ray set of a file.
pub const FILE_SET: &str = "file";

/// Rays that were traced and their answers.
#[derive(Clone, Debug, Default)]
pub struct SavedRays {
    /// The hard case that this is about.
    pub case: Option<String>,
    /// World, metres; rays and triangles are relative to it.
    pub frame_origin: [f64; 3],
    /// Corners by global triangle id, metres.
    pub triangles: Vec<[[f32; 3]; 3]>,
    /// By global triangle id: 0 without a back, 1 where the clockwise side is one that rays may pass, 2 where
    /// the counter-clockwise one is. Empty for a hard case.
    pub backs: Vec<u32>,
    /// One entry a ray set.
    pub sets: Vec<SavedSet>,
}

/// A ray set with all answers to it.
#[derive(Clone, Debug)]
pub struct SavedSet {
    /// Such as `camera`.
    pub name: String,
    /// As they were traced.
    pub rays: Vec<Ray>,
    /// The oracle's answers, one a ray.
    pub truth: Vec<TrueHit>,
    /// The systems' answers.
    pub answers: Vec<Answers>,
}

/// The answers of a system to a ray set.
#[derive(Clone, Debug)]
pub struct Answers {
    /// System and preset, such as `mmrt-robust`; with the options of several values where it takes part with
    /// several, such as `bvh-robust.leaf=2,children=4`.
    pub name: String,
    /// Says whether a hit's `a` and `b` are weights of vertices.
    pub kind: StructureKind,
    /// One a ray.
    pub hits: Vec<Hit>,
}

/// Sums of samples, one entry per pixel, rows from the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilmSums {
    /// Linear Rec. 709, W/(sr m^2).
    pub sums: Vec<[f32; 3]>,
    /// Samples in each sum: those that were made and are finite.
    pub counts: Vec<u32>,
}

/// Result of a render. Images have `width * height` pixels, rows from the top.
#[derive(Clone, Debug, Default)]
pub struct RenderOutput {
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Mean over the samples done; linear Rec. 709, W/(sr m^2).
    pub beauty: Vec<[f32; 3]>,
    /// Sums of those samples, where [`RenderJob::shard`] asked for a share of them.
    pub sums: Option<FilmSums>,
    /// Those in addition that [`RenderJob::aovs`] asked for.
    pub aovs: BTreeMap<Aov, AovImage>,
    /// Samples per pixel in `beauty`, of adaptive samples the most that a pixel could get; fewer than asked
    /// for after an early end.
    pub samples_done: u32,
    /// Sharing of the samples among the pixels, where some got more than others.
    pub adaptive: Option<AdaptiveRecord>,
    /// Options of the structure as resolved from preset and command line.
    pub options: BTreeMap<String, Value>,
    /// Paths taken where the device decides: builder, coverage, atomics.
    pub paths: BTreeMap<String, String>,
    /// Time of each stage, in the order of a frame.
    pub stages: Vec<StageTime>,
    /// Time of each pass.
    pub passes: Vec<Pass>,
    /// The four figures and the ray rate.
    pub times: Times,
    /// Spread of repeated times, by the name of their median.
    pub spread: BTreeMap<String, Spread>,
    /// Bytes.
    pub memory: Option<Memory>,
    /// Counts that do not depend on the machine.
    pub counters: Option<Counters>,
}

impl RenderOutput {
    /// Record of the render for a report.
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

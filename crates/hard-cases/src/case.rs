use super::catalogue::{Targets, catalogue_row};
use super::grid::Grid;
use super::random::Stream;
use rasray_metrics::{DeviceHit, Truth};
use rasray_reference::oracle::{Ray, Verdict};

/// Three corners in metres.
pub type Triangle = [[f32; 3]; 3];

/// Size and seed of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scale {
    /// Number of rays to generate. Cases that consist of a few listed rays have no more than those.
    pub rays: usize,
    /// Seed of the random rays.
    pub seed: u64,
    /// True if meshes have the size of the catalogue, and not one for software drivers.
    pub full: bool,
}

impl Scale {
    /// Size for every test run.
    pub const QUICK: Self = Self { rays: 2000, seed: 1, full: false };
    /// Size that bounds a failure rate by 2e-5 if no ray fails.
    pub const FULL: Self = Self { rays: 150_000, seed: 1, full: true };
}

/// Scene with rays.
#[derive(Clone, Debug)]
pub struct HardCase {
    /// Short and unique id.
    pub id: &'static str,
    /// One line that describes the case and the danger in it.
    pub title: &'static str,
    /// Triangles in the order of their ids. They may hold coordinates that loaders must drop.
    pub triangles: Vec<Triangle>,
    /// Rays; some may be invalid on purpose.
    pub rays: Vec<Ray>,
    /// Centre of views.
    pub eye: [f32; 3],
    /// Answers that are known by construction.
    pub expect: Expectation,
    /// Size and seed with which the case was made.
    pub scale: Scale,
    /// Name of the measured quantity.
    pub measure: &'static str,
    /// Demands on each kind of structure.
    pub target: Targets,
    /// Bound of |dt| / t for structures that find triangles, if the catalogue gives one.
    pub largest_dt: Option<f64>,
    /// Voxels for which the case is made, if it is about voxels.
    pub grid: Option<Grid>,
}

/// Point that a camera at the eye of a case looks at, relative to the eye. Its angle of view is a right angle
/// in both directions.
pub const CAMERA_TOWARDS: [f64; 3] = [0.25, 0.125, 1.0];

/// Answers to all rays of a case that are known by construction.
#[derive(Clone, Debug, PartialEq)]
pub enum Expectation {
    /// The oracle decides.
    Oracle,
    /// One answer for all rays.
    All(Answer),
    /// One answer per ray.
    PerRay(Vec<Answer>),
}

/// Answer to one ray that is known by construction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// The oracle decides.
    Oracle,
    /// Nothing is hit.
    Miss,
    /// Something is hit, however close to an edge the ray passes: a watertight test finds it.
    Hit,
    /// Something is hit, as for `Hit`, at this t up to the relative tolerance.
    HitAt {
        /// Ray parameter in units of the direction's length.
        t: f32,
        /// Relative tolerance of t.
        tolerance: f32,
    },
    /// Something is hit, as for `HitAt`, on this triangle, even if another one lies at the same t.
    HitOn {
        /// Running index of the triangle.
        primitive: u32,
        /// Ray parameter in units of the direction's length.
        t: f32,
        /// Relative tolerance of t.
        tolerance: f32,
    },
    /// Hit or miss; a hit must be finite and have a t in this closed range.
    Anything {
        /// Least and greatest t.
        t: [f32; 2],
    },
}

impl HardCase {
    /// Returns the known answer to a ray.
    pub fn answer(&self, ray: usize) -> Answer {
        match &self.expect {
            Expectation::Oracle => Answer::Oracle,
            Expectation::All(answer) => *answer,
            Expectation::PerRay(answers) => answers.get(ray).copied().unwrap_or(Answer::Oracle),
        }
    }

    /// Returns positions and indices, three of each for every triangle.
    pub fn buffers(&self) -> (Vec<[f32; 3]>, Vec<u32>) {
        (self.triangles.as_flattened().to_vec(), (0..self.triangles.len() as u32 * 3).collect())
    }

    /// True if a structure that finds triangles may give this answer to a ray with this verdict.
    ///
    /// For unambiguous rays the triangle must be the oracle's, and t must lie within its rounding, plus or
    /// minus `t_tolerance` (relative); for ambiguous rays the answer must be admissible. The answer known by
    /// construction must hold as well.
    pub fn accepts(&self, ray: usize, verdict: &Verdict, hit: Option<DeviceHit>, t_tolerance: f64) -> bool {
        if hit.is_some_and(|hit| !hit.t.is_finite()) {
            return false;
        }
        let answer = self.answer(ray);
        match (&answer, hit) {
            (Answer::Anything { t }, Some(hit)) => return t[0] <= hit.t && hit.t <= t[1],
            (Answer::Anything { .. }, None) => return true,
            _ => {}
        }
        answer.holds_for(hit) && oracle_accepts(verdict, hit, t_tolerance)
    }
}

impl Answer {
    /// True if a hit or miss agrees with the answer known by construction.
    pub fn holds_for(&self, hit: Option<DeviceHit>) -> bool {
        let close = |t: f32, tolerance: f32| {
            hit.is_some_and(|hit| (f64::from(hit.t) - f64::from(t)).abs() <= f64::from(tolerance * t.abs()))
        };
        match *self {
            Self::Oracle => true,
            Self::Miss => hit.is_none(),
            Self::Hit => hit.is_some(),
            Self::HitAt { t, tolerance } => close(t, tolerance),
            Self::HitOn { primitive, t, tolerance } => {
                close(t, tolerance)
                    && hit.is_some_and(|hit| hit.primitive.is_none_or(|found| found == primitive))
            }
            Self::Anything { t } => hit.is_none_or(|hit| t[0] <= hit.t && hit.t <= t[1]),
        }
    }
}

fn oracle_accepts(verdict: &Verdict, hit: Option<DeviceHit>, t_tolerance: f64) -> bool {
    match hit {
        None if verdict.is_ambiguous() => verdict.admits_miss(),
        Some(hit) if verdict.is_ambiguous() => verdict.admits_hit(hit.primitive, f64::from(hit.t)),
        None => verdict.hit().is_none(),
        Some(hit) => {
            let [low, high] = verdict.t_range;
            let (t, slack) = (f64::from(hit.t), t_tolerance * f64::from(hit.t).abs());
            verdict.hit().is_some_and(|(primitive, _)| hit.primitive.is_none_or(|found| found == primitive))
                && low - slack <= t
                && t <= high + slack
        }
    }
}

/// Row of the catalogue.
pub(super) struct Entry {
    pub id: &'static str,
    pub title: &'static str,
    /// Parameter that distinguishes the variants of a case; unused (0) if there is only one.
    pub parameter: f32,
    pub build: fn(&Context) -> Content,
}

/// Triangles, rays and expectation that the construction of a case yields.
pub(super) struct Content {
    pub triangles: Vec<Triangle>,
    pub rays: Vec<Ray>,
    pub eye: [f32; 3],
    pub expect: Expectation,
    pub grid: Option<Grid>,
}

/// Inputs of the construction of a case.
pub(super) struct Context {
    pub id: &'static str,
    pub parameter: f32,
    pub scale: Scale,
}

impl Entry {
    pub fn build(&self, scale: Scale) -> HardCase {
        let context = Context { id: self.id, parameter: self.parameter, scale };
        let Content { triangles, rays, eye, expect, grid } = (self.build)(&context);
        let row = catalogue_row(self.id).expect("a test looks every case up");
        let (measure, target, largest_dt) = (row.measure, row.target, row.largest_dt);
        HardCase {
            id: self.id,
            title: self.title,
            triangles,
            rays,
            eye,
            expect,
            scale,
            measure,
            target,
            largest_dt,
            grid,
        }
    }
}

impl Context {
    /// Makes the requested number of rays, each from its own stream of random numbers and its index.
    pub fn rays(&self, ray: impl Fn(&mut Stream, usize) -> Ray) -> Vec<Ray> {
        (0..self.scale.rays).map(|index| ray(&mut self.stream(index), index)).collect()
    }

    /// Makes rays like [`Context::rays`], with the known answer to each.
    pub fn answered(&self, ray: impl Fn(&mut Stream, usize) -> (Ray, Answer)) -> (Vec<Ray>, Expectation) {
        let (rays, answers) = (0..self.scale.rays).map(|index| ray(&mut self.stream(index), index)).unzip();
        (rays, Expectation::PerRay(answers))
    }

    fn stream(&self, index: usize) -> Stream {
        Stream::new(self.id, self.scale.seed, index as u64)
    }
}

impl Content {
    /// Makes a case seen from the origin.
    pub fn new(triangles: Vec<Triangle>, rays: Vec<Ray>, expect: Expectation) -> Self {
        Self { triangles, rays, eye: [0.0; 3], expect, grid: None }
    }

    /// Moves the centre of the views.
    pub fn seen_from(self, eye: [f32; 3]) -> Self {
        Self { eye, ..self }
    }

    /// Sets the voxels for which the case is made.
    pub fn on(self, grid: Grid) -> Self {
        Self { grid: Some(grid), ..self }
    }
}

/// Answer to aimed rays: they have their target at t = 1, up to the rounding of their direction and of f32
/// depth.
pub(super) const AIMED: Answer = Answer::HitAt { t: 1.0, tolerance: 1e-5 };

//! Cost of a run: times, bytes, and counts that do not depend on the machine.

use crate::absent::absent;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Spread of the repeated times of one figure, milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spread {
    /// Number of repetitions timed, after one that warms up.
    pub count: u64,
    /// Shortest time.
    pub min: f64,
    /// First quartile.
    pub q1: f64,
    /// Third quartile.
    pub q3: f64,
    /// Longest time.
    pub max: f64,
}

/// Clock that measured the times.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Timer {
    /// Timestamps of the device.
    Device,
    /// Clock of the host around submit and wait.
    Host,
}

/// Times of the figures of a run, milliseconds, and the ray rate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// Clock that measured the times.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timer: Option<Timer>,
    /// Time of posing, from instances to posed positions.
    #[serde(default, skip_serializing_if = "absent")]
    pub pose_ms: Option<f64>,
    /// Time of the build, from posed positions to a traceable structure, host work included.
    #[serde(default, skip_serializing_if = "absent")]
    pub build_ms: Option<f64>,
    /// Time of the host's part of the build.
    #[serde(default, skip_serializing_if = "absent")]
    pub build_host_ms: Option<f64>,
    /// Time of the first build, until it is complete, including the driver's compilation of kernels on first
    /// use and builds that had to grow.
    #[serde(default, skip_serializing_if = "absent")]
    pub first_build_ms: Option<f64>,
    /// Time of the first dispatch of every kernel of an image, with one pixel, which includes the driver's
    /// compilation on first use. No other figure but `frame_ms` contains it. Absent where the picture before
    /// used the kernels already.
    #[serde(default, skip_serializing_if = "absent")]
    pub first_use_ms: Option<f64>,
    /// Time of the trace, from rays to hits.
    #[serde(default, skip_serializing_if = "absent")]
    pub trace_ms: Option<f64>,
    /// Time of finding first hits of camera rays by drawing; absent where these rays were traced.
    #[serde(default, skip_serializing_if = "absent")]
    pub visible_ms: Option<f64>,
    /// Time of all passes of an image on the device: traces, drawing and shading; absent for sets of rays.
    #[serde(default, skip_serializing_if = "absent")]
    pub image_ms: Option<f64>,
    /// Time of the whole frame.
    #[serde(default, skip_serializing_if = "absent")]
    pub frame_ms: Option<f64>,
    /// Number of rays traced in `trace_ms`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rays: Option<u64>,
    /// Rate in millions of rays per second.
    #[serde(default, skip_serializing_if = "absent")]
    pub mrays_per_s: Option<f64>,
}

/// Time of a stage of a frame: milliseconds of all its passes, and of the host's work for it, together in one
/// repetition.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StageTime {
    /// Name of the stage: `pose`, `build`, `shadow-maps`, `visible`, `trace-closest`, `trace-occluded`,
    /// `surfaces`, `shade` or `film`.
    pub stage: String,
    /// Median time.
    pub ms: f64,
    /// Spread of the times.
    pub spread: Spread,
}

/// Figure of a run that a pass is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PassOf {
    /// Figure [`Times::pose_ms`].
    Pose,
    /// Figure [`Times::build_ms`], where builds were repeated to be timed.
    Build,
    /// Figure [`Times::trace_ms`] of a set of rays.
    Trace,
    /// Figure [`Times::image_ms`].
    Image,
}

/// Time of a pass, or of the host's work beside the passes: milliseconds of all its dispatches together in
/// one repetition, after warm-up.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pass {
    /// Path of the pass's shader, [`Pass::HOST`] or [`Pass::WAITING`].
    pub label: String,
    /// Stage that the pass belongs to, as [`StageTime::stage`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stage: Option<String>,
    /// Figure that the pass is part of.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<PassOf>,
    /// Share of the pass in its figure: its time in the repetition whose time is the median of the figure, or
    /// the mean of its times in the two repetitions in the middle. The shares of a figure add up to the
    /// figure, which the medians of the passes need not.
    #[serde(default, skip_serializing_if = "absent")]
    pub ms_share: Option<f64>,
    /// Number of dispatches of the pass in that repetition.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dispatches: Option<u64>,
    /// Median time.
    pub ms_median: f64,
    /// Shortest time.
    pub ms_min: f64,
    /// Longest time.
    pub ms_max: f64,
    /// First quartile of the times.
    #[serde(default, skip_serializing_if = "absent")]
    pub ms_q1: Option<f64>,
    /// Third quartile of the times.
    #[serde(default, skip_serializing_if = "absent")]
    pub ms_q3: Option<f64>,
    /// Number of repetitions measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u64>,
}

impl Pass {
    /// Label of the host's own part of a build, [`Times::build_host_ms`], such as a tree that the host
    /// builds, and of the host's part of a pose, such as the matrices of a rig.
    pub const HOST: &'static str = "host, before recording";
    /// Label of the rest of the host's time of a build: recording, submitting, and waiting beyond the passes.
    pub const WAITING: &'static str = "host, recording and waiting";
}

/// Memory of a run, bytes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Memory {
    /// Bytes of the structure's allocations after the final build.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub structure_bytes: Option<u64>,
    /// Bytes that the formula of the system's page gives for the counted fragments, entries and cells.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub formula_bytes: Option<u64>,
    /// Bytes that the structure's pools can hold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub capacity_bytes: Option<u64>,
    /// Bytes that are allocated only to measure.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diagnostic_bytes: Option<u64>,
    /// Bytes of the buffers of an image: film, queues, states, and buffers of drawing; without structure,
    /// scene and shadow maps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame_bytes: Option<u64>,
    /// Bytes per pixel of the image, `frame_bytes` over its pixels.
    #[serde(default, skip_serializing_if = "absent")]
    pub frame_bytes_per_pixel: Option<f64>,
    /// Most bytes that were allocated on the device at a time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device_peak_bytes: Option<u64>,
    /// Bytes of each named part.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub by_part: BTreeMap<String, u64>,
}

/// Counts of the lists of one group of a structure's cells.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ListRecord {
    /// Group of cells: `all`, a face of the cube such as `+x`, `camera`, the view along an axis such as `x`,
    /// `voxels` or `grid`.
    pub cells_of: String,
    /// Number of cells in the group.
    pub cells: u64,
    /// Number of cells that hold something; for voxels, the number that rays search.
    pub occupied: u64,
    /// Number of fragments in all these cells, or of triangles, each counted once per cell.
    pub layers: u64,
    /// Mean number of layers over the occupied cells; absent where there are none.
    #[serde(default, skip_serializing_if = "absent")]
    pub layers_mean: Option<f64>,
    /// Number of layers in the cell with the most layers.
    pub layers_most: u64,
    /// Number of entries in the lists: greater than `layers` where a triangle is in several buckets of a
    /// cell.
    pub entries: u64,
    /// Number of slots that the lists occupy: greater than `entries` where lists grow by pages.
    pub slots: u64,
    /// Bytes of the slots that hold no entry.
    pub waste_bytes: u64,
}

/// Counts that do not depend on the machine.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Counters {
    /// Number of fragments stored.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fragments: Option<u64>,
    /// Number of triangles with an area that cover no cell's centre in any view, so that rays pass through
    /// them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lost: Option<u64>,
    /// Share of samples whose first surface sent a mirrored or a refracted ray on. Present for images whose
    /// integrator traces on only from some surfaces.
    #[serde(default, skip_serializing_if = "absent")]
    pub selected_share: Option<f64>,
    /// Number of list entries stored.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub entries: Option<u64>,
    /// Counts of the lists of the structure's cells: all cells together first, then view by view.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lists: Vec<ListRecord>,
    /// Number of list entries or tree nodes read per ray.
    #[serde(default, skip_serializing_if = "absent")]
    pub nodes_per_ray: Option<f64>,
    /// Number of cells stepped per ray.
    #[serde(default, skip_serializing_if = "absent")]
    pub cells_per_ray: Option<f64>,
    /// Number of primitive tests per ray.
    #[serde(default, skip_serializing_if = "absent")]
    pub tests_per_ray: Option<f64>,
    /// Number of views entered per ray; absent where the structure has none.
    #[serde(default, skip_serializing_if = "absent")]
    pub views_per_ray: Option<f64>,
    /// Share of stepped cells in which nothing was read, because the cell was empty or rejected by its
    /// bounds, buckets or masks; absent where no cell was stepped.
    #[serde(default, skip_serializing_if = "absent")]
    pub rejected_share: Option<f64>,
    /// Number of entries that the pools were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub demand: Option<u64>,
    /// Number of entries that the pools can hold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub capacity: Option<u64>,
    /// Number of entries missing from the structure that was traced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub overflow: Option<u64>,
    /// Number of builds repeated with larger pools.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub regrows: Option<u64>,
    /// Number of rays without an answer after the last round.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unfinished: Option<u64>,
    /// Number of rays that would have passed more transparent surfaces than a ray may; absent where there are
    /// no such surfaces.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cut: Option<u64>,
}

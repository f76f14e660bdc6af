//! Cost of a run: times, bytes, and counts that do not depend on the machine.

use crate::absent::absent;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The times of one figure, milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spread {
    /// Repetitions timed, after one that warms up.
    pub count: u64,
    /// Shortest.
    pub min: f64,
    /// First quartile.
    pub q1: f64,
    /// Third quartile.
    pub q3: f64,
    /// Longest.
    pub max: f64,
}

/// Clock that measured the times.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Timer {
    /// Timestamps of the device.
    Device,
    /// The host's clock around submit and wait.
    Host,
}

/// The four figures, milliseconds, and the ray rate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// Clock that measured them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timer: Option<Timer>,
    /// Instances to posed positions.
    #[serde(default, skip_serializing_if = "absent")]
    pub pose_ms: Option<f64>,
    /// Posed positions to traceable, host work included.
    #[serde(default, skip_serializing_if = "absent")]
    pub build_ms: Option<f64>,
    /// The host's part of the build.
    #[serde(default, skip_serializing_if = "absent")]
    pub build_host_ms: Option<f64>,
    /// The first build, until complete: what the driver compiles on first use and builds that had to grow
    /// included.
    #[serde(default, skip_serializing_if = "absent")]
    pub first_build_ms: Option<f64>,
    /// The first dispatch of every kernel of an image, with one pixel: what the driver compiles on first use.
    /// In no other figure but `frame_ms`. Absent where they had been used, for the picture before.
    #[serde(default, skip_serializing_if = "absent")]
    pub first_use_ms: Option<f64>,
    /// Rays in to hits out.
    #[serde(default, skip_serializing_if = "absent")]
    pub trace_ms: Option<f64>,
    /// First hits of camera rays by drawing; absent where these were traced.
    #[serde(default, skip_serializing_if = "absent")]
    pub visible_ms: Option<f64>,
    /// All passes of an image on the device, traces, drawing and shading; absent for sets of rays.
    #[serde(default, skip_serializing_if = "absent")]
    pub image_ms: Option<f64>,
    /// Everything.
    #[serde(default, skip_serializing_if = "absent")]
    pub frame_ms: Option<f64>,
    /// Rays traced in `trace_ms`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rays: Option<u64>,
    /// Millions of rays per second.
    #[serde(default, skip_serializing_if = "absent")]
    pub mrays_per_s: Option<f64>,
}

/// A stage of a frame: milliseconds of all its passes, and of what the host does for it, in one repetition
/// together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StageTime {
    /// `pose`, `build`, `shadow-maps`, `visible`, `trace-closest`, `trace-occluded`, `surfaces`, `shade` or
    /// `film`.
    pub stage: String,
    /// Median.
    pub ms: f64,
    /// Spread of the times.
    pub spread: Spread,
}

/// The figure of a run that a pass is a part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PassOf {
    /// [`Times::pose_ms`].
    Pose,
    /// [`Times::build_ms`], where builds were repeated to be timed.
    Build,
    /// [`Times::trace_ms`] of a set of rays.
    Trace,
    /// [`Times::image_ms`].
    Image,
}

/// A pass, or what the host does beside them: milliseconds of all its dispatches in one repetition together,
/// after warm-up.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pass {
    /// The path of its shader, [`Pass::HOST`] or [`Pass::WAITING`].
    pub label: String,
    /// The stage that it belongs to, as [`StageTime::stage`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stage: Option<String>,
    /// The figure that it is a part of.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<PassOf>,
    /// Its share of the figure that it is a part of: its time in the repetition whose time is that median, or
    /// the mean of the two in the middle. The shares of a figure add up to it, which medians of the parts
    /// need not.
    #[serde(default, skip_serializing_if = "absent")]
    pub ms_share: Option<f64>,
    /// Times it was dispatched in that repetition.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dispatches: Option<u64>,
    /// Median.
    pub ms_median: f64,
    /// Shortest.
    pub ms_min: f64,
    /// Longest.
    pub ms_max: f64,
    /// First quartile.
    #[serde(default, skip_serializing_if = "absent")]
    pub ms_q1: Option<f64>,
    /// Third quartile.
    #[serde(default, skip_serializing_if = "absent")]
    pub ms_q3: Option<f64>,
    /// Repetitions measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u64>,
}

impl Pass {
    /// Label of the host's own part of a build, [`Times::build_host_ms`], such as a tree that it builds, and
    /// of a pose, such as the matrices of a rig.
    pub const HOST: &'static str = "host, before recording";
    /// Label of what else the host sees of a build: recording, submitting, and waiting beyond the passes.
    pub const WAITING: &'static str = "host, recording and waiting";
}

/// Bytes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Memory {
    /// The structure's allocations after the final build.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub structure_bytes: Option<u64>,
    /// The formula of the system's page on counted fragments, entries and cells.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub formula_bytes: Option<u64>,
    /// Capacity of the structure's pools.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub capacity_bytes: Option<u64>,
    /// Kept only to measure.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diagnostic_bytes: Option<u64>,
    /// Buffers of an image: film, queues, states, and those of drawing; without structure, scene and shadow
    /// maps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame_bytes: Option<u64>,
    /// `frame_bytes` per pixel of the image.
    #[serde(default, skip_serializing_if = "absent")]
    pub frame_bytes_per_pixel: Option<f64>,
    /// Most that was allocated on the device at a time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device_peak_bytes: Option<u64>,
    /// Bytes of each named part.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub by_part: BTreeMap<String, u64>,
}

/// Counts of the lists of some cells of a structure.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ListRecord {
    /// Cells: `all`, a face of the cube such as `+x`, `camera`, the view along an axis such as `x`, `voxels`
    /// or `grid`.
    pub cells_of: String,
    /// All of them.
    pub cells: u64,
    /// Those that hold something; of voxels, those that rays search.
    pub occupied: u64,
    /// Fragments in all these cells, or triangles, each once per cell.
    pub layers: u64,
    /// Mean over the occupied cells; absent where there are none.
    #[serde(default, skip_serializing_if = "absent")]
    pub layers_mean: Option<f64>,
    /// Layers of the cell that has most.
    pub layers_most: u64,
    /// Entries in their lists: more than layers where a triangle is in several buckets of a cell.
    pub entries: u64,
    /// Slots that the lists take: more than entries where they grow by pages.
    pub slots: u64,
    /// Bytes of the slots that no entry fills.
    pub waste_bytes: u64,
}

/// Counts that do not depend on the machine.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Counters {
    /// Fragments stored.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fragments: Option<u64>,
    /// Triangles with an area that cover no cell's centre in any view, so that rays pass through them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lost: Option<u64>,
    /// The share of samples whose first surface sent a mirrored or a refracted ray on. There for images whose
    /// integrator traces on from some surfaces alone.
    #[serde(default, skip_serializing_if = "absent")]
    pub selected_share: Option<f64>,
    /// List entries stored.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub entries: Option<u64>,
    /// Counts of the lists of the structure's cells: all together first, then view by view.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lists: Vec<ListRecord>,
    /// List entries or tree nodes read per ray.
    #[serde(default, skip_serializing_if = "absent")]
    pub nodes_per_ray: Option<f64>,
    /// Cells stepped per ray.
    #[serde(default, skip_serializing_if = "absent")]
    pub cells_per_ray: Option<f64>,
    /// Primitive tests per ray.
    #[serde(default, skip_serializing_if = "absent")]
    pub tests_per_ray: Option<f64>,
    /// Views entered per ray; absent where the structure has none.
    #[serde(default, skip_serializing_if = "absent")]
    pub views_per_ray: Option<f64>,
    /// Share of the cells stepped in which nothing was read: empty, or rejected by their bounds, buckets or
    /// masks; absent where none was stepped.
    #[serde(default, skip_serializing_if = "absent")]
    pub rejected_share: Option<f64>,
    /// Entries that the pools were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub demand: Option<u64>,
    /// Entries that the pools can hold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub capacity: Option<u64>,
    /// Entries missing from what was traced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub overflow: Option<u64>,
    /// Builds repeated with larger pools.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub regrows: Option<u64>,
    /// Rays without an answer after the last round.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unfinished: Option<u64>,
    /// Rays that would have passed more transparent surfaces than a ray may; absent where there are none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cut: Option<u64>,
}

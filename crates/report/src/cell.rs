//! A run of a comparison in a line of its own: what it depends on, and its place in the comparison's list.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Settings that one run of a comparison depends on: one system on one set of rays, or the image of one
/// system.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cell {
    /// Name of the scene, or of a hard case with `hard:` before it.
    pub scene: String,
    /// Hash of everything that the scene was made from, as it is shown and lit.
    pub content: String,
    /// When it is shown, seconds; absent at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_s: Option<f64>,
    /// Names of the clips that are played.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub clips: Vec<String>,
    /// From where it is seen; absent for hard cases, which have an eye of their own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<CellView>,
    /// Data that is uploaded and compiled in, by name; absent for hard cases, where it is everything.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub needs: Option<Vec<String>>,
    /// Such as `mmrt`; of a file of hits its name in the report.
    pub system: String,
    /// `robust` or `published`; `given` for a file of hits, as in a run.
    pub preset: String,
    /// As in a run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variant: Option<String>,
    /// Options over those of the preset, as they read.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub options: BTreeMap<String, String>,
    /// Hash of the hits of a file; absent where rays are traced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hits: Option<String>,
    /// Rays that are traced; absent for images, and for files that are only loaded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rays: Option<CellRays>,
    /// Image that is rendered; absent for rays.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image: Option<CellImage>,
    /// True if the contents of the structure's lists were counted.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub lists: bool,
    /// Seed of all random numbers.
    pub seed: u32,
    /// Builds and traces that are timed.
    pub repetitions: u32,
}

/// From where a scene is seen.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellView {
    /// Every number of the camera, to the last bit.
    pub camera: String,
    /// Pixels a row, rows: of the image, and of the camera's rays.
    pub size: [u32; 2],
    /// Rays that pass the backs of single-sided surfaces.
    pub back_faces: String,
}

/// A set of rays.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellRays {
    /// Such as `camera`; the id of a hard case.
    pub set: String,
    /// Rays that are asked for; of a file those that it has.
    pub count: u32,
    /// Hash of the rays of a file; absent for sets that are drawn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub content: Option<String>,
}

/// An image.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellImage {
    /// Such as `path`.
    pub integrator: String,
    /// Its options, also those at their default, as they read.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub options: BTreeMap<String, String>,
    /// Samples per pixel.
    pub spp: u32,
    /// Rule by which pixels get as many samples as their noise needs: the threshold and the least samples, as
    /// in `0.02 16`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adaptive: Option<String>,
    /// Source of random numbers.
    pub sampler: String,
    /// Way in which first hits of camera rays are found.
    pub primary: String,
    /// Occluder of shadow rays.
    pub occluder: String,
    /// Texels along a side of a shadow map, where it is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shadow_resolution: Option<u32>,
    /// Points on each emitting triangle that have shadow maps; absent where rays to these were traced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shadow_points: Option<u32>,
}

/// A cell as one of a comparison's.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellRecord {
    /// Key of the run, 64 hexadecimal digits: a hash of the program and of all that it depends on.
    pub key: String,
    /// Place in the list of the comparison, from 0.
    pub place: u32,
    /// Cells of the list.
    pub cells: u32,
    /// Key of the list, equal for all its cells: a hash of their keys.
    pub list: String,
    /// The campaign that asked for it; absent for a comparison.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub campaign: Option<CampaignRecord>,
    /// Settings that the run depends on.
    pub depends_on: Cell,
}

/// A campaign that a cell is of.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CampaignRecord {
    /// Title of its plan, one line.
    pub title: String,
    /// Those that show the cell, in the order of the plan.
    pub experiments: Vec<ExperimentRecord>,
}

/// An experiment of a plan.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExperimentRecord {
    /// Place in the plan, from 0.
    pub place: u32,
    /// One line.
    pub name: String,
    /// Settings of the plan for the comparison of the cell, by the names of options, such as `environment`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub settings: BTreeMap<String, String>,
}

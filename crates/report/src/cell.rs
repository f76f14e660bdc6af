//! Cell of a comparison, one run in a line of its own: the settings that it depends on, and its place in the
//! list of the comparison.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Settings that one run of a comparison depends on: one system on one set of rays, or the image of one
/// system.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cell {
    /// Name of the scene, or of a hard case with `hard:` before it.
    pub scene: String,
    /// Hash of everything that the scene was made from, including its pose and its lights.
    pub content: String,
    /// Time at which the scene is shown, seconds; absent at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_s: Option<f64>,
    /// Names of the animation clips that are played.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub clips: Vec<String>,
    /// View from which the scene is seen; absent for hard cases, which have an eye of their own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<CellView>,
    /// Names of the scene data that is uploaded and compiled in; absent for hard cases, which need all of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub needs: Option<Vec<String>>,
    /// Name of the system, such as `mmrt`; for a file of hits its name in the report.
    pub system: String,
    /// Preset of the system: `robust` or `published`; `given` for a file of hits, as in a run.
    pub preset: String,
    /// Options in which the system differs from others of the same name and preset, as in a run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variant: Option<String>,
    /// Options that override those of the preset, as they are written.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub options: BTreeMap<String, String>,
    /// Hash of the hits in a file; absent where rays are traced.
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
    /// Number of builds and traces that are timed.
    pub repetitions: u32,
}

/// View from which a scene is seen.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellView {
    /// Camera, with every number exact to the last bit.
    pub camera: String,
    /// Width and height in pixels, of the image and of the camera's rays.
    pub size: [u32; 2],
    /// Rays that pass the backs of single-sided surfaces, such as `camera`.
    pub back_faces: String,
}

/// Set of rays of a cell.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellRays {
    /// Name of the set, such as `camera`; for a hard case its id.
    pub set: String,
    /// Number of rays that are asked for; for a file the number that it holds.
    pub count: u32,
    /// Hash of the rays in a file; absent for sets that are drawn at random.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub content: Option<String>,
}

/// Image of a cell.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellImage {
    /// Name of the integrator, such as `path`.
    pub integrator: String,
    /// Options of the integrator, including those at their default, as they are written.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub options: BTreeMap<String, String>,
    /// Samples per pixel.
    pub spp: u32,
    /// Rule by which pixels get as many samples as their noise needs: the threshold and the least number of
    /// samples, as in `0.02 16`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adaptive: Option<String>,
    /// Source of random numbers.
    pub sampler: String,
    /// Method by which first hits of camera rays are found.
    pub primary: String,
    /// Occluder of shadow rays: the structure or shadow maps.
    pub occluder: String,
    /// Texels along a side of a shadow map; absent without shadow maps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shadow_resolution: Option<u32>,
    /// Points on each emitting triangle that have shadow maps; absent where rays to these points were traced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shadow_points: Option<u32>,
}

/// Record of a cell in the list of its comparison.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellRecord {
    /// Key of the run, 64 hexadecimal digits: a hash of the program and of all settings that the run depends
    /// on.
    pub key: String,
    /// Place of the cell in the list of the comparison, from 0.
    pub place: u32,
    /// Number of cells in the list.
    pub cells: u32,
    /// Key of the list, equal for all its cells: a hash of the keys of these cells.
    pub list: String,
    /// Campaign that asked for the cell; absent for a comparison.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub campaign: Option<CampaignRecord>,
    /// Settings that the run depends on.
    pub depends_on: Cell,
}

/// Campaign that a cell belongs to.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CampaignRecord {
    /// Title of the campaign's plan, one line.
    pub title: String,
    /// Experiments that show the cell, in the order of the plan.
    pub experiments: Vec<ExperimentRecord>,
}

/// Experiment of a campaign's plan.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExperimentRecord {
    /// Place of the experiment in the plan, from 0.
    pub place: u32,
    /// Name of the experiment, one line.
    pub name: String,
    /// Settings of the plan for the comparison of the cell, by the names of options, such as `environment`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub settings: BTreeMap<String, String>,
}

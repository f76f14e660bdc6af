//! What was measured: the JSON that machines read and the table that people read.

pub mod figures;
pub mod html;
mod schema;
mod table;

pub use schema::{
    Accuracy, Counters, Device, ImageError, Memory, Pass, Report, Run, SCHEMA, SceneRecord, Timer, Times,
};
pub use table::table;
pub(crate) use table::{bytes, columns, grouped};

use crate::scene_source::LoadedScene;

impl Report {
    /// A report of `runs` on a device and a scene, with this build's version and commit.
    pub fn new(device: Device, scene: &LoadedScene, runs: Vec<Run>) -> Self {
        Self {
            schema: SCHEMA.to_owned(),
            version: crate::VERSION.to_owned(),
            commit: crate::COMMIT.map(str::to_owned),
            device,
            scene: SceneRecord {
                name: scene.scene.name.clone(),
                triangles: scene.triangles,
                sha256: scene.sha256.clone(),
            },
            runs,
        }
    }

    /// The report as JSON text with a line break at its end. A number that is not finite is left out
    /// like one that was not measured: JSON has no word for it.
    pub fn to_json(&self) -> String {
        let mut text =
            serde_json::to_string_pretty(self).expect("strings, numbers and maps with string keys");
        text.push('\n');
        text
    }
}

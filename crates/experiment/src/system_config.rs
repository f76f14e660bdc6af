//! A system with its preset and options, as jobs name it.

use crate::error::ExperimentError;
use rasray_scene::needs::{Integrator, Workload};
use rasray_scene::{Camera, Projection};
use rasray_systems::{Preset, Spec, System};
use serde_json::{Map, Value};

/// Most columns and rows of a camera's view.
const CAMERA_LIMIT: u32 = 8192;

/// What was asked of a structure, by option; what is left out follows the system's preset. Numbers are numbers, all else
/// words.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StructureOptions(Map<String, Value>);

impl StructureOptions {
    /// The options that were given, by name.
    pub fn given(&self) -> &Map<String, Value> {
        &self.0
    }

    /// What was given for an option, as it is typed.
    pub fn text(&self, option: &str) -> Option<String> {
        self.0.get(option).map(text)
    }

    /// Every option that was given, as it is typed.
    pub fn texts(&self) -> impl Iterator<Item = (String, String)> {
        self.0.iter().map(|(name, value)| (name.clone(), text(value)))
    }

    /// The same with a word for an option.
    #[must_use]
    pub fn with(mut self, option: &str, word: impl Into<Value>) -> Self {
        self.0.insert(option.to_owned(), word.into());
        self
    }

    /// The options that were given and whose names `keep` accepts.
    #[must_use]
    pub fn filtered(&self, keep: impl Fn(&str) -> bool) -> Self {
        Self(self.0.clone().into_iter().filter(|(name, _)| keep(name)).collect())
    }

    /// These options with those of `over` in place of their own where it has any.
    #[must_use]
    pub fn overlaid(&self, over: &Self) -> Self {
        Self(self.0.clone().into_iter().chain(over.0.clone()).collect())
    }
}

fn text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

/// A system with what was asked of it.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemConfig {
    /// The system.
    pub system: &'static System,
    /// Its preset.
    pub preset: Preset,
    /// Options over the preset; only such that the system has.
    pub options: StructureOptions,
    /// The options of several values, where the system takes part once with each.
    pub variant: Option<String>,
}

impl SystemConfig {
    /// The same for renders of a workload: published fragments carry what their paper keeps for occlusion
    /// where nothing else is asked for, unless a payload was given. Comparisons keep the preset's, since rays
    /// are compared in addition to the image.
    #[must_use]
    pub fn serving(mut self, workload: Workload) -> Self {
        let occlusion = workload.integrator == Integrator::AmbientOcclusion;
        if occlusion
            && self.preset == Preset::Published
            && self.options.text("payload").is_none()
            && let Some(word) = self.system.occlusion_payload
        {
            self.options = self.options.with("payload", word);
        }
        self
    }

    /// The same where a camera looks at the scene: published structures whose paper draws the camera's view draw it, a cell
    /// a pixel of the image, unless views were given. A parallel projection has no such view.
    #[must_use]
    pub fn seen_by(mut self, camera: &Camera, width: u32, height: u32) -> Self {
        let perspective = matches!(camera.projection, Projection::Perspective { .. });
        if let Some(views) = self.system.camera_views
            && perspective
            && self.preset == Preset::Published
            && self.options.text("views").is_none()
        {
            self.options = self.options.with("views", views);
            if self.options.text("camera-resolution").is_none() {
                let [columns, rows] = [width, height].map(|side| side.min(CAMERA_LIMIT));
                self.options = self.options.with("camera-resolution", format!("{columns}x{rows}"));
            }
        }
        self
    }

    /// What images of a workload lack: a warning where they shade and fragments carry nothing to shade by.
    pub fn shortcoming(&self, workload: Workload) -> Option<String> {
        let payload =
            self.options.text("payload").filter(|payload| ["normal", "plane"].contains(&payload.as_str()))?;
        (workload.integrator != Integrator::AmbientOcclusion).then(|| {
            let system = self.system.name;
            format!("{system}: fragments with --payload {payload} carry nothing to shade by, so that surfaces are white")
        })
    }

    /// What the registry makes the structure from.
    ///
    /// # Errors
    /// A usage error for values that do not go together; none for a config of the command line.
    pub fn spec(&self) -> Result<Spec, ExperimentError> {
        Spec::new(self.system.name, self.preset.name(), self.options.texts()).map_err(|error| {
            ExperimentError::usage(error.to_string(), "change the option, or leave it to the preset")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlaying_replaces_only_what_is_given() {
        let base = StructureOptions::default().with("buckets", 4).with("sort", "on");
        let over = StructureOptions::default().with("buckets", 8).with("thickness", "0.1");
        let both = base.overlaid(&over);
        assert_eq!(both, base.with("buckets", 8).with("thickness", "0.1"));
        let kept = both.filtered(|name| name != "buckets");
        assert_eq!((kept.text("buckets"), kept.given().len()), (None, 2));
    }
}

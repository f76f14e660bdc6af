//! A system with its preset and options, as jobs name it.

use crate::error::ExperimentError;
use crate::frame::{Frame, Primary};
use rasray_options::{OptionValues, Value};
use rasray_scene::needs::Workload;
use rasray_scene::{Camera, Projection};
use rasray_systems::{Preset, Spec, System, VIEW_LIMIT};

/// A system with what was asked of it.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemConfig {
    /// The system.
    pub system: &'static System,
    /// Its preset.
    pub preset: Preset,
    /// Options over the preset; only such that the system has.
    pub options: OptionValues,
    /// The options of several values, where the system takes part once with each.
    pub variant: Option<String>,
    /// Why it was taken, where none was asked for.
    pub chosen: Option<String>,
}

impl SystemConfig {
    /// A system that was asked for, with these options over its preset.
    pub fn new(system: &'static System, preset: Preset, options: OptionValues) -> Self {
        Self { system, preset, options, variant: None, chosen: None }
    }

    /// Sets the payload for renders of a workload: published fragments carry what their paper keeps for
    /// occlusion where nothing else is asked for, unless a payload was given. Comparisons keep the preset's,
    /// since rays are compared in addition to the image.
    #[must_use]
    pub fn serving(mut self, workload: Workload) -> Self {
        if workload.is_visibility()
            && self.preset == Preset::Published
            && self.options.get("payload").is_none()
            && let Some(word) = self.system.frame.and_then(|frame| frame.occlusion_payload)
        {
            self.options.set("payload", word);
        }
        self
    }

    /// Sets the views for a frame that a camera sees: published structures whose paper draws the camera's
    /// view draw it, a cell a pixel of the image, unless views were given, and so do all from which first
    /// hits are taken. A parallel projection has no such view.
    #[must_use]
    pub fn seen_by(mut self, camera: &Camera, frame: &Frame) -> Self {
        let draws = self.preset == Preset::Published || frame.primary == Primary::Fragments;
        let perspective = matches!(camera.projection, Projection::Perspective { .. });
        if let Some(views) = self.system.frame.and_then(|frame| frame.camera_views)
            && perspective
            && draws
            && self.options.get("views").is_none()
        {
            self.options.set("views", views);
            if self.options.get("camera-resolution").is_none() {
                let cells = [frame.width, frame.height].map(|side| side.min(VIEW_LIMIT));
                self.options.set("camera-resolution", Value::Cells(cells));
            }
        }
        self
    }

    /// Warning for images of a workload that shades where fragments carry nothing to shade by.
    pub fn shortcoming(&self, workload: Workload) -> Option<String> {
        let payload = self.options.get("payload").and_then(Value::word);
        let payload = payload.filter(|payload| ["normal", "plane"].contains(payload))?;
        (!workload.is_visibility()).then(|| {
            let system = self.system.name;
            format!("{system}: fragments with `payload` {payload} carry nothing to shade by, so that surfaces are white")
        })
    }

    /// Spec that the registry makes the structure from.
    ///
    /// # Errors
    /// Values do not go together; those of a config of the command line do.
    pub fn spec(&self) -> Result<Spec, ExperimentError> {
        Ok(Spec::of(self.system, self.preset, self.options.clone())?)
    }
}

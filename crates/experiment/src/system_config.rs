//! Configuration of a system: its preset and options, as jobs name it.

use crate::error::ExperimentError;
use crate::frame::{Frame, Primary};
use rasray_options::{OptionValues, Value};
use rasray_scene::needs::Workload;
use rasray_scene::{Camera, Projection};
use rasray_systems::{Preset, Spec, System, VIEW_LIMIT};

/// System with the preset and options that were asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemConfig {
    /// The system.
    pub system: &'static System,
    /// Preset of the system.
    pub preset: Preset,
    /// Options that override the preset; only options that the system has.
    pub options: OptionValues,
    /// Options with several values, if the system takes part once with each value.
    pub variant: Option<String>,
    /// Reason for the choice of the system, if the user asked for none.
    pub chosen: Option<String>,
}

impl SystemConfig {
    /// Makes the configuration of a system that was asked for, with these options over its preset.
    pub fn new(system: &'static System, preset: Preset, options: OptionValues) -> Self {
        Self { system, preset, options, variant: None, chosen: None }
    }

    /// Sets the payload for renders of a workload: published fragments carry the payload that their paper
    /// keeps for occlusion if nothing else is asked for, unless a payload was given. Comparisons keep the
    /// preset's payload, since they compare rays in addition to the image.
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

    /// Sets the views for a frame that a camera sees. Published structures whose paper draws the camera's
    /// view draw it, with a cell per pixel of the image, unless views were given; so do all structures from
    /// which first hits are taken. A parallel projection has no such view.
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

    /// Returns a warning for images of a workload that shades, if fragments carry no data for shading.
    pub fn shortcoming(&self, workload: Workload) -> Option<String> {
        let payload = self.options.get("payload").and_then(Value::word);
        let payload = payload.filter(|payload| ["normal", "plane"].contains(payload))?;
        (!workload.is_visibility()).then(|| {
            let system = self.system.name;
            format!("{system}: fragments with `payload` {payload} carry nothing to shade by, so that surfaces are white")
        })
    }

    /// Makes the spec from which the registry makes the structure.
    ///
    /// # Errors
    /// Values do not go together, which cannot happen for a configuration of the command line.
    pub fn spec(&self) -> Result<Spec, ExperimentError> {
        Ok(Spec::of(self.system, self.preset, self.options.clone())?)
    }
}

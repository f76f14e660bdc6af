//! Backends, which carry out jobs: the choice of a device, its description, and progress.

use crate::error::ExperimentError;
use crate::jobs::{CompareJob, Comparison, HardJob, RenderJob, RenderOutput};
use crate::render_job::KeptScene;
use rasray_gpu::PassCommands;
use rasray_gpu_scene::TexelRuns;
use rasray_report::{Device, ListRecord, Run};
use std::ops::ControlFlow;

/// Choice of the device.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DeviceChoice {
    /// Position in the driver's list, or part of a device's name, case ignored. Absent for the first suitable
    /// device, hardware before software.
    pub device: Option<String>,
    /// True to enable validation layers, whose messages are errors.
    pub validation: bool,
}

/// Progress of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress<'a> {
    /// Name of the task, such as `build` or `mmrt robust incoherent`.
    pub task: &'a str,
    /// Number of units finished.
    pub done: u64,
    /// Number of units in all; 0 where that is not known.
    pub total: u64,
    /// Name of a unit, in the plural, such as `samples`.
    pub unit: &'a str,
}

/// Callback that receives progress at least once per wave of samples or rays; `Break` asks for an early end.
pub type OnProgress<'a> = dyn FnMut(Progress<'_>) -> ControlFlow<()> + 'a;

/// Complete run of a comparison.
#[derive(Clone, Copy, Debug)]
pub struct FinishedRun<'a> {
    /// Place of the run's cell.
    pub place: usize,
    /// Result of the run.
    pub run: &'a Run,
    /// Image of the run, `width * height` pixels of the frame, linear Rec. 709, rows from the top; absent for
    /// rays.
    pub pixels: Option<&'a [[f32; 3]]>,
}

/// Callback that receives each run of a comparison as soon as the run is complete; `Break` asks for an early
/// end.
pub type OnRun<'a> = dyn FnMut(FinishedRun<'_>) -> ControlFlow<()> + 'a;

/// Feature of the device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Feature {
    /// Name of the feature in the Vulkan specification.
    pub name: String,
    /// True if the device has the feature.
    pub present: bool,
    /// True if nothing runs without the feature.
    pub required: bool,
    /// Purpose of the feature.
    pub purpose: String,
}

/// Choice that a structure makes on a device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChosenPath {
    /// Name of the system.
    pub system: String,
    /// Name of the choice, such as `addressing`.
    pub choice: String,
    /// Value that was chosen.
    pub chosen: String,
    /// Reason for the choice.
    pub reason: String,
}

/// Description of the device in use, and its consequences for each structure.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DeviceDescription {
    /// Names of all devices in the driver's order; positions are what `--device` takes.
    pub devices: Vec<String>,
    /// Vulkan version of the device in use, such as `1.3.230`.
    pub api_version: String,
    /// Features that any part of this project asks for.
    pub features: Vec<Feature>,
    /// Names and values of limits that decide something in this project, with their units in the text.
    pub limits: Vec<(String, String)>,
    /// Choices of each structure on this device.
    pub paths: Vec<ChosenPath>,
}

/// Number of texels that a device can hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TexelCapacity {
    /// Largest number of texels, over all levels of all textures.
    pub texels: u64,
    /// Name of the device.
    pub device: String,
}

impl TexelCapacity {
    /// Returns the capacity of a device.
    pub fn of(device: &rasray_gpu::Device) -> Self {
        let texels = TexelRuns::of(device.limits()).most_texels();
        Self { texels, device: device.name().to_owned() }
    }
}

/// Backend that runs jobs on a device. Every method reports failures of the device and lost data as
/// [`ExperimentError`].
pub trait Backend {
    /// Returns the device in use, for reports.
    fn device(&self) -> Device;

    /// Returns the number of texels that the device in use can hold.
    fn texel_capacity(&self) -> TexelCapacity;

    /// Renders an image with the state `kept` of the image before, and keeps the state that the next can use.
    /// If `progress` breaks, the samples done so far are the result.
    fn render(
        &mut self,
        job: &RenderJob<'_>,
        kept: &mut KeptScene,
        progress: &mut OnProgress<'_>,
    ) -> Result<RenderOutput, ExperimentError>;

    /// Compares systems: one run per system, preset and ray set, and per image where wanted. Systems take
    /// turns on each set of rays, so that all runs of a set are complete at the same time. If `progress` or
    /// `finished` breaks, the complete runs so far are the result.
    fn compare(
        &mut self,
        job: &CompareJob<'_>,
        finished: &mut OnRun<'_>,
        progress: &mut OnProgress<'_>,
    ) -> Result<Comparison, ExperimentError>;

    /// Compares systems on a hard case: one run per system and preset, each with its verdict. If `progress`
    /// breaks before the case is complete, the result has no runs.
    fn hard(
        &mut self,
        job: &HardJob<'_>,
        progress: &mut OnProgress<'_>,
    ) -> Result<Comparison, ExperimentError>;

    /// Lists the commands, pass by pass, that the structure of a job records for a complete build, for traces
    /// of both kinds and for the lookup of surfaces.
    fn passes(&mut self, job: &RenderJob<'_>) -> Result<Vec<PassCommands>, ExperimentError>;

    /// Counts the lists of a job's structure after its build: all cells together first, then view by view.
    fn lists(&mut self, job: &RenderJob<'_>) -> Result<Vec<ListRecord>, ExperimentError>;

    /// Describes the device.
    fn info(&mut self) -> Result<DeviceDescription, ExperimentError>;
}

/// Callback that makes a [`Backend`] on the wanted device.
pub type OpenBackend<'a> = dyn FnMut(&DeviceChoice) -> Result<Box<dyn Backend>, ExperimentError> + 'a;

//! Backends, which carry jobs out: the choice of a device, its description, progress.

use crate::error::ExperimentError;
use crate::jobs::{CompareJob, Comparison, HardJob, RenderJob, RenderOutput};
use crate::render_job::KeptScene;
use rasray_gpu::PassCommands;
use rasray_gpu_scene::TexelRuns;
use rasray_report::{Device, ListRecord, Run};
use std::ops::ControlFlow;

/// Device that is wanted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DeviceChoice {
    /// A position in the driver's list, or part of a device's name, case ignored. Absent: the first
    /// suitable one, hardware before software.
    pub device: Option<String>,
    /// Validation layers on; a message of theirs is an error.
    pub validation: bool,
}

/// Progress of the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress<'a> {
    /// Name of the task, such as `build` or `mmrt robust incoherent`.
    pub task: &'a str,
    /// Units finished.
    pub done: u64,
    /// Units in all; 0 where that is not known.
    pub total: u64,
    /// Name of a unit, in the plural, such as `samples`.
    pub unit: &'a str,
}

/// Told of progress at least once per wave of samples or rays; `Break` asks for an early end.
pub type OnProgress<'a> = dyn FnMut(Progress<'_>) -> ControlFlow<()> + 'a;

/// A run of a comparison that is whole.
#[derive(Clone, Copy, Debug)]
pub struct FinishedRun<'a> {
    /// The place of its cell.
    pub place: usize,
    /// Its result.
    pub run: &'a Run,
    /// Its image, `width * height` pixels of the frame, linear Rec. 709, rows from the top; absent of rays.
    pub pixels: Option<&'a [[f32; 3]]>,
}

/// Told of each run of a comparison as soon as it is whole; `Break` asks for an early end.
pub type OnRun<'a> = dyn FnMut(FinishedRun<'_>) -> ControlFlow<()> + 'a;

/// A feature of the device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Feature {
    /// Name in the Vulkan specification.
    pub name: String,
    /// True if the device has it.
    pub present: bool,
    /// True if nothing runs without it.
    pub required: bool,
    /// Its use.
    pub purpose: String,
}

/// The way a structure takes on a device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChosenPath {
    /// The system.
    pub system: String,
    /// Name of the choice, such as `addressing`.
    pub choice: String,
    /// The value chosen.
    pub chosen: String,
    /// Why.
    pub reason: String,
}

/// The device in use and what it means for each structure.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DeviceDescription {
    /// Names of all devices in the driver's order; positions are what `--device` takes.
    pub devices: Vec<String>,
    /// Vulkan version of the device in use, such as `1.3.230`.
    pub api_version: String,
    /// Features that something here asks for.
    pub features: Vec<Feature>,
    /// Limits that decide something here, with their units in the text.
    pub limits: Vec<(String, String)>,
    /// Choices of each structure here.
    pub paths: Vec<ChosenPath>,
}

/// Number of texels that a device holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TexelCapacity {
    /// At most, of all levels of all textures.
    pub texels: u64,
    /// Name of the device.
    pub device: String,
}

impl TexelCapacity {
    /// The capacity of a device.
    pub fn of(device: &rasray_gpu::Device) -> Self {
        let texels = TexelRuns::of(device.limits()).most_texels();
        Self { texels, device: device.name().to_owned() }
    }
}

/// Runs jobs on a device. Every method reports failures of the device and lost data as [`ExperimentError`].
pub trait Backend {
    /// The device in use, for reports.
    fn device(&self) -> Device;

    /// Number of texels that the device in use holds.
    fn texel_capacity(&self) -> TexelCapacity;

    /// Renders an image with what was `kept` of the one before, and keeps what the next can use. When
    /// `progress` breaks, the samples done so far are the result.
    fn render(
        &mut self,
        job: &RenderJob<'_>,
        kept: &mut KeptScene,
        progress: &mut OnProgress<'_>,
    ) -> Result<RenderOutput, ExperimentError>;

    /// Compares systems: a run per system, preset and ray set, and per image where wanted. Systems take turns
    /// on each set of rays, so the runs of a set are whole together. When `progress` or `finished` breaks,
    /// the complete runs so far are the result.
    fn compare(
        &mut self,
        job: &CompareJob<'_>,
        finished: &mut OnRun<'_>,
        progress: &mut OnProgress<'_>,
    ) -> Result<Comparison, ExperimentError>;

    /// Compares systems on a hard case: a run per system and preset, each with its verdict. When
    /// `progress` breaks before the case is whole, there are none.
    fn hard(
        &mut self,
        job: &HardJob<'_>,
        progress: &mut OnProgress<'_>,
    ) -> Result<Comparison, ExperimentError>;

    /// Commands that the structure of a job records for a build that is complete, for traces of both kinds
    /// and for surfaces, pass by pass.
    fn passes(&mut self, job: &RenderJob<'_>) -> Result<Vec<PassCommands>, ExperimentError>;

    /// Counts of the lists of a job's structure once it is built: all cells together first, then view by
    /// view.
    fn lists(&mut self, job: &RenderJob<'_>) -> Result<Vec<ListRecord>, ExperimentError>;

    /// Describes the device.
    fn info(&mut self) -> Result<DeviceDescription, ExperimentError>;
}

/// Makes a [`Backend`] on the wanted device.
pub type OpenBackend<'a> = dyn FnMut(&DeviceChoice) -> Result<Box<dyn Backend>, ExperimentError> + 'a;

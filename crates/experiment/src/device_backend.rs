//! Backend that carries out jobs on a Vulkan device.

use rasray_gpu::{Device as GpuDevice, DeviceDesc};

use crate::backend::{Backend, DeviceChoice, DeviceDescription, OnProgress, OnRun, TexelCapacity};
use crate::built::Built;
use crate::describe::requirements;
use crate::device_record::device_record;
use crate::device_scene::DeviceScene;
use crate::error::ExperimentError;
use crate::jobs::{CompareJob, Comparison, HardJob, RenderJob, RenderOutput};
use crate::render_job::KeptScene;
use rasray_report::{Device, ListRecord};

/// Number of pipelines kept for structures that are made again: those of hard cases, of variants, and of
/// frames with other triangles.
const KEPT_PIPELINES: usize = 256;

/// Backend on one device. Everything made for a job is dropped with the job, except the state that its caller
/// keeps.
struct DeviceBackend {
    device: GpuDevice,
    validation: bool,
}

impl DeviceBackend {
    /// Opens the wanted device.
    fn open(choice: &DeviceChoice) -> Result<Self, ExperimentError> {
        let device = open_device(choice)?;
        Ok(Self { device, validation: choice.validation })
    }

    /// Turns messages of the validation layer into errors.
    fn check_validation(&self) -> Result<(), ExperimentError> {
        match self.device.validation_messages().first() {
            Some(message) if self.validation => Err(ExperimentError::Validation { message: message.clone() }),
            _ => Ok(()),
        }
    }
}

impl Backend for DeviceBackend {
    fn device(&self) -> Device {
        device_record(&self.device)
    }

    fn texel_capacity(&self) -> TexelCapacity {
        TexelCapacity::of(&self.device)
    }

    fn render(
        &mut self,
        job: &RenderJob<'_>,
        kept: &mut KeptScene,
        progress: &mut OnProgress<'_>,
    ) -> Result<RenderOutput, ExperimentError> {
        let output = crate::render_job::render(&self.device, job, kept, progress)?;
        self.check_validation()?;
        Ok(output)
    }

    fn compare(
        &mut self,
        job: &CompareJob<'_>,
        finished: &mut OnRun<'_>,
        progress: &mut OnProgress<'_>,
    ) -> Result<Comparison, ExperimentError> {
        let comparison = crate::compare::compare(&self.device, job, finished, progress)?;
        self.check_validation()?;
        Ok(comparison)
    }

    fn hard(
        &mut self,
        job: &HardJob<'_>,
        progress: &mut OnProgress<'_>,
    ) -> Result<Comparison, ExperimentError> {
        let comparison = crate::hard::hard(&self.device, job, progress)?;
        self.check_validation()?;
        Ok(comparison)
    }

    fn passes(&mut self, job: &RenderJob<'_>) -> Result<Vec<rasray_gpu::PassCommands>, ExperimentError> {
        let passes = crate::pass_list::pass_list(&self.device, job)?;
        self.check_validation()?;
        Ok(passes)
    }

    fn lists(&mut self, job: &RenderJob<'_>) -> Result<Vec<ListRecord>, ExperimentError> {
        let (mut stage, _) = DeviceScene::of_job(&self.device, job)?;
        let built =
            Built::refreshed(&self.device, &job.system.spec()?, &mut stage, (job.scene, job.refresh))?;
        let lists = built.lists(&self.device)?;
        self.check_validation()?;
        Ok(lists)
    }

    fn info(&mut self) -> Result<DeviceDescription, ExperimentError> {
        crate::describe::describe(&self.device)
    }
}

/// Opens the wanted device, for code that uses the device directly.
///
/// # Errors
/// [`ExperimentError::Opening`]: no such device exists, or it lacks a required feature.
pub fn open_device(choice: &DeviceChoice) -> Result<GpuDevice, ExperimentError> {
    let device = GpuDevice::create(&DeviceDesc {
        requirements: requirements(),
        preference: choice.device.clone(),
        validation: choice.validation,
        application: "rasray".to_owned(),
    })
    .map_err(ExperimentError::Opening)?;
    device.keep_pipelines(KEPT_PIPELINES);
    tracing::info!(device = device.name(), why = device.why_chosen(), "device");
    Ok(device)
}

/// Opens the wanted device for jobs.
///
/// # Errors
/// As for [`open_device`].
pub fn open(choice: &DeviceChoice) -> Result<Box<dyn Backend>, ExperimentError> {
    Ok(Box::new(DeviceBackend::open(choice)?))
}

//! The back end on Vulkan: a device, the systems of the registry, and the two jobs it is given.

mod compare;
mod contestant;
mod describe;
mod hard;
mod hard_verdict;
mod images;
mod judge;
mod passes;
mod rays;
mod render;
mod replay;
mod stage;
mod traced_set;
mod work_maps;

use rasray_gpu::{Device as GpuDevice, DeviceDesc, Feature, Requirements};
use rasray_gpu_scene::TexelRuns;

use crate::backend::{
    Backend, CompareJob, Comparison, DeviceChoice, DeviceDescription, HardJob, OnProgress, RenderJob,
    RenderOutput, TexelRoom,
};
use crate::error::AppError;
use crate::report::Device;

/// A device and nothing else: everything made for a job goes with the job.
pub(crate) struct Renderer {
    device: GpuDevice,
    validation: bool,
}

/// What any system may want of a device; each names what it cannot do without when it is made.
fn requirements() -> Requirements {
    let mut requirements = Requirements::floor();
    requirements.optional.push((Feature::FragmentStoresAndAtomics, "structures built by the rasterizer"));
    requirements
        .optional
        .push((Feature::BufferDeviceAddress, "pools beyond the binding limit (--addressing address)"));
    requirements
}

impl Renderer {
    /// Opens the wanted device.
    pub(crate) fn open(choice: &DeviceChoice) -> Result<Self, AppError> {
        let device = GpuDevice::create(&DeviceDesc {
            requirements: requirements(),
            preference: choice.device.clone(),
            validation: choice.validation,
            application: "rasray".to_owned(),
        })
        .map_err(|error| AppError::device(error, "`rasray info` lists the devices and what they lack"))?;
        tracing::info!(device = device.name(), why = device.why_chosen(), "device");
        Ok(Self { device, validation: choice.validation })
    }

    /// Messages of the validation layer are errors.
    fn check_validation(&self) -> Result<(), AppError> {
        match self.device.validation_messages().first() {
            Some(message) if self.validation => Err(AppError::device(
                format!("the validation layer says: {message}"),
                "this is a defect; please report it with the command line",
            )),
            _ => Ok(()),
        }
    }
}

impl Backend for Renderer {
    fn device(&self) -> Device {
        Device {
            name: self.device.name().to_owned(),
            driver: self.device.driver().to_owned(),
            software: self.device.is_software(),
        }
    }

    fn texel_room(&self) -> TexelRoom {
        let texels = TexelRuns::of(self.device.limits()).most_texels();
        TexelRoom { texels, device: self.device.name().to_owned() }
    }

    fn render(
        &mut self,
        job: &RenderJob<'_>,
        progress: &mut OnProgress<'_>,
    ) -> Result<RenderOutput, AppError> {
        let output = render::render(&self.device, job, progress)?;
        self.check_validation()?;
        Ok(output)
    }

    fn compare(
        &mut self,
        job: &CompareJob<'_>,
        progress: &mut OnProgress<'_>,
    ) -> Result<Comparison, AppError> {
        let comparison = compare::compare(&self.device, job, progress)?;
        self.check_validation()?;
        Ok(comparison)
    }

    fn hard(&mut self, job: &HardJob<'_>, progress: &mut OnProgress<'_>) -> Result<Comparison, AppError> {
        let comparison = hard::hard(&self.device, job, progress)?;
        self.check_validation()?;
        Ok(comparison)
    }

    fn info(&mut self) -> Result<DeviceDescription, AppError> {
        describe::describe(&self.device)
    }
}

//! Shared parts of the tests of faults: a device, a small picture, a few hits.
//!
//! The faults themselves are in `rasray_gpu::faults`, which exists only where the feature `fault-injection`
//! of `rasray-gpu` is on: in the tests of this package.

mod child;
mod error;
mod picture;
mod random;
mod scene;

pub use child::in_child;
pub use error::Failure;
pub use picture::{picture, picture_of};
pub use random::scrambled;
pub use scene::{hits, rays, spec, specs, stage, stage_of, textured_room};

use rasray_gpu::{Device, DeviceDesc, Feature, GpuError, Requirements};

/// Enough for every preset of every system.
const KEPT_PIPELINES: usize = 512;

/// The device floor, and as options what any system of the registry wants beyond it.
pub fn requirements() -> Requirements {
    let mut requirements = Requirements::floor();
    requirements.optional.push((Feature::BufferDeviceAddress, "pools beyond the binding limit"));
    for wanted in specs().iter().flatten().filter_map(|spec| spec.requirements().ok()) {
        let required = wanted.required.into_iter().map(|feature| (feature, "a system of the registry"));
        requirements.optional.extend(required.chain(wanted.optional));
    }
    requirements.merge(&Requirements::default())
}

/// A device with these requirements, under validation.
///
/// # Errors
/// As [`Device::create`].
pub fn device_with(requirements: Requirements) -> Result<Device, GpuError> {
    let device = Device::create(&DeviceDesc { requirements, validation: true, ..DeviceDesc::default() })?;
    // Tests make the same structures again and again.
    device.keep_pipelines(KEPT_PIPELINES);
    Ok(device)
}

/// A device as the command makes it, under validation.
///
/// # Errors
/// As [`Device::create`].
pub fn device() -> Result<Device, GpuError> {
    device_with(requirements())
}

/// Drops the last handle of a device and tells what validation said from first to last.
pub fn finish(device: Device) -> Vec<String> {
    let log = device.validation_log();
    drop(device);
    log.messages()
}

//! What the tests of faults do again and again: a device, a small picture, a few hits.
//!
//! The faults themselves are in `rasray_gpu::faults`, which exists only where the feature `fault-injection` of
//! `rasray-gpu` is on: in the tests of this package.

mod error;
mod picture;
mod scene;

pub use error::Failure;
pub use picture::picture;
pub use scene::{hits, rays, spec, specs, stage};

use rasray_gpu::{Device, DeviceDesc, Feature, GpuError, Requirements};

/// What the command asks of a device.
pub fn requirements() -> Requirements {
    let mut requirements = Requirements::floor();
    requirements.optional.push((Feature::FragmentStoresAndAtomics, "structures built by the rasterizer"));
    requirements.optional.push((Feature::BufferDeviceAddress, "pools beyond the binding limit"));
    requirements
}

/// A device with these requirements, under validation.
///
/// # Errors
/// As [`Device::create`].
pub fn device_with(requirements: Requirements) -> Result<Device, GpuError> {
    Device::create(&DeviceDesc { requirements, validation: true, ..DeviceDesc::default() })
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

/// Whether the large counts are asked for.
pub fn is_full() -> bool {
    std::env::var_os("RASRAY_FULL").is_some_and(|value| value == "1")
}

//! Description of the device for `rasray info`.

use rasray_gpu::{Device, Feature as GpuFeature, Requirements};
use rasray_gpu_scene::{TEXEL_BYTES, TexelRuns};
use rasray_systems::{SYSTEMS, Spec};

use crate::backend::{ChosenPath, DeviceDescription, Feature};
use crate::error::ExperimentError;

/// Returns the requirements that any system may have of a device. A system names the features that it cannot
/// do without when it is made.
pub fn requirements() -> Requirements {
    let mut requirements = Requirements::floor();
    requirements.optional.push((
        GpuFeature::FragmentStoresAndAtomics,
        "structures built by the rasterizer, and `primary` raster",
    ));
    requirements
        .optional
        .push((GpuFeature::BufferDeviceAddress, "pools beyond the binding limit (`addressing` address)"));
    for feature in [GpuFeature::AccelerationStructure, GpuFeature::RayQuery] {
        requirements.optional.push((feature, "driver-rt, the driver's own tree"));
    }
    requirements
        .optional
        .push((GpuFeature::ConservativeRasterization, "`coverage` conservative-extension of dirt"));
    requirements.optional.push((GpuFeature::Int64, "faster reads of bvh on software devices"));
    requirements
}

/// Describes the devices, and the consequences of the one in use for each system.
pub(super) fn describe(device: &Device) -> Result<DeviceDescription, ExperimentError> {
    let wanted = requirements();
    let devices = Device::list(&wanted)?;
    let required = wanted.required.iter().map(|feature| (feature, true, "nothing runs without it"));
    let optional = wanted.optional.iter().map(|(feature, purpose)| (feature, false, *purpose));
    let features = required
        .chain(optional)
        .map(|(feature, required, purpose)| Feature {
            name: feature.name().to_owned(),
            present: device.has(*feature),
            required,
            purpose: purpose.to_owned(),
        })
        .collect();
    let limits = device.limits();
    let mut paths = Vec::new();
    for system in SYSTEMS {
        for preset in system.presets {
            let spec = Spec::new(system.name, preset.name(), [])?;
            let missing = device.lacks(&spec.requirements()?);
            let (chosen, reason) = if missing.is_empty() {
                ("runs".to_owned(), "the device has every feature and limit that it requires".to_owned())
            } else {
                ("cannot run".to_owned(), format!("the device lacks {}", missing.join(", ")))
            };
            paths.push(ChosenPath {
                system: system.name.to_owned(),
                choice: preset.name().to_owned(),
                chosen,
                reason,
            });
        }
    }
    Ok(DeviceDescription {
        devices: devices.iter().map(|summary| summary.name.clone()).collect(),
        api_version: version_text(device.api_version()),
        features,
        limits: vec![
            ("largest pool per binding".to_owned(), format!("{} bytes", limits.max_storage_buffer_range)),
            (
                "texels of a scene".to_owned(),
                format!("{} bytes", TEXEL_BYTES * TexelRuns::of(limits).most_texels()),
            ),
            ("storage buffers per shader stage".to_owned(), limits.max_storage_buffers_per_stage.to_string()),
        ],
        paths,
    })
}

/// Writes major, minor and patch of a packed Vulkan version.
fn version_text(version: u32) -> String {
    format!("{}.{}.{}", version >> 22 & 0x7F, version >> 12 & 0x3FF, version & 0xFFF)
}

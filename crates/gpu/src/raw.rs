//! A device that a host made, for structures that run inside the renderer of the host.

use std::sync::Arc;

use ash::vk;

use crate::choose::Candidate;
use crate::device::{Device, Parts};
use crate::error::{GpuError, Result};
use crate::features::Feature;
use crate::memory::Memory;
use crate::messages::ValidationLog;

/// A device of a host, with the facts about it that this crate must know. The host keeps ownership of every
/// handle.
#[derive(Clone)]
pub struct RawDevice {
    /// Instance that the device was made from.
    pub instance: ash::Instance,
    /// Physical device.
    pub physical: vk::PhysicalDevice,
    /// Logical device.
    pub device: ash::Device,
    /// Queue that [`Device::submit`] and related functions use; null if these are never called.
    pub queue: vk::Queue,
    /// Family of the command buffers that will be recorded into; the family must support compute.
    pub queue_family: u32,
    /// Vulkan version that the host requested when it made the instance, as in `VkApplicationInfo`.
    pub api_version: u32,
    /// Features that the host enabled; at least [`Feature::Synchronization2`].
    pub enabled: Vec<Feature>,
    /// True if the host enabled `VK_EXT_debug_utils`, so that this crate sets names and labels. Must be false
    /// with a validation layer older than 1.3.242, which may write labels of a destroyed command buffer to
    /// freed memory.
    pub debug_utils: bool,
    /// Cache for all pipelines, or null.
    pub pipeline_cache: vk::PipelineCache,
    /// Source of memory; if absent, this crate allocates memory itself.
    pub memory: Option<Arc<dyn Memory>>,
    /// Maximum of the memory allocated through this device, in bytes.
    pub memory_limit: Option<u64>,
}

impl Device {
    /// Adopts a device of a host. This crate destroys no handle of `raw`.
    ///
    /// # Safety
    /// - Instance, physical device, device, queue, queue family and pipeline cache belong together and are
    ///   valid until the last object made from the returned device is dropped.
    /// - `api_version` is at most the version that the instance was made for.
    /// - Every feature in `enabled` was enabled when the device was made (with its extension where it is
    ///   one), and `debug_utils` is true only if that extension is enabled and no validation layer older
    ///   than 1.3.242 is.
    /// - The queue is not used elsewhere while [`Device::submit`], [`Device::upload`], [`Device::download`]
    ///   or any other function that is documented to submit runs, such as a constructor of a queue of rays or
    ///   of a film; and the pipeline cache was made without
    ///   `VK_PIPELINE_CACHE_CREATE_EXTERNALLY_SYNCHRONIZED_BIT`.
    ///
    /// # Errors
    /// [`GpuError::FeatureNotEnabled`] if synchronization2 is not in `enabled`, [`GpuError::InvalidUse`] if
    /// the device does not support a feature in `enabled` or the queue family cannot compute.
    pub unsafe fn from_raw(raw: RawDevice) -> Result<Device> {
        if raw.api_version < vk::API_VERSION_1_2 {
            // The queries below exist only in instances of Vulkan 1.2 or newer.
            return Err(GpuError::InvalidUse {
                name: "the device handed in".to_owned(),
                reason: "its instance must be made for Vulkan 1.2 or newer".to_owned(),
            });
        }
        // SAFETY: the caller guarantees that the physical device belongs to the instance.
        let candidate = unsafe { Candidate::inspect(&raw.instance, raw.physical, Some(raw.queue_family)) }?;
        let invalid = |reason: String| GpuError::InvalidUse { name: candidate.name.clone(), reason };
        let api_version = raw.api_version.min(candidate.api_version);
        if !candidate.is_usable() {
            return Err(invalid("Vulkan 1.2 and a queue family that computes are needed".to_owned()));
        }
        if !raw.enabled.contains(&Feature::Synchronization2) {
            return Err(GpuError::FeatureNotEnabled {
                feature: Feature::Synchronization2,
                what: "recording barriers".to_owned(),
            });
        }
        if let Some(feature) = raw.enabled.iter().find(|feature| !candidate.present.contains(feature)) {
            return Err(invalid(format!("{feature} is said to be enabled, but the device does not have it")));
        }
        Self::assemble(Parts {
            instance: raw.instance,
            owned: None,
            log: ValidationLog::default(),
            candidate: &candidate,
            device: raw.device,
            queue: Some(raw.queue),
            enabled: raw.enabled.into_iter().collect(),
            debug_utils: raw.debug_utils,
            labels: true,
            pipeline_cache: raw.pipeline_cache,
            memory: raw.memory,
            memory_limit: raw.memory_limit,
            api_version,
            why_chosen: "handed in by the host".to_owned(),
        })
    }
}

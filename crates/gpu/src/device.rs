//! The device: chosen and made here, or made by a host (see [`crate::RawDevice`]).

use std::collections::BTreeSet;
use std::ffi::CStr;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex};

use ash::vk;

use crate::choose::{Candidate, DeviceSummary, candidates, choose};
use crate::device_core::{Commands, Core, Identity};
use crate::error::{During, GpuError, Result};
use crate::features::{Feature, FeatureStructs};
use crate::instance::Instance;
use crate::limits::Limits;
use crate::memory::{Ledger, PooledMemory};
use crate::messages::ValidationLog;
use crate::pipeline_store::PipelineStore;
use crate::requirements::{Missing, Requirements};
use crate::set_parts::SetLayouts;

/// Description of a device to be made: its selection and settings.
#[derive(Debug, Clone)]
pub struct DeviceDesc {
    /// Features that the device must have and those that it may have. No other feature is enabled.
    pub requirements: Requirements,
    /// Index or part of the name of the preferred device; if absent, the best suitable device is chosen.
    pub preference: Option<String>,
    /// True if the validation layer checks all calls; an error if the layer is not installed.
    pub validation: bool,
    /// Name of the application, shown by tools.
    pub application: String,
}

impl Default for DeviceDesc {
    /// The requirements of the device floor, no preference, no validation.
    fn default() -> Self {
        Self {
            requirements: Requirements::floor(),
            preference: None,
            validation: false,
            application: "rasray".to_owned(),
        }
    }
}

/// A Vulkan device with one queue. It makes buffers and pipelines, and submits recorded commands.
/// [`Device::create`] makes a device, [`Device::from_raw`] takes that of a host.
///
/// Clones are handles to the same device, which lives as long as any of them or any object made from it.
#[derive(Clone)]
pub struct Device {
    pub(crate) core: Arc<Core>,
}

impl std::fmt::Debug for Device {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Device").field("name", &self.name()).finish_non_exhaustive()
    }
}

impl Device {
    /// Makes the best device that fulfils the requirements: discrete before integrated before virtual before
    /// software. Logs the chosen device and the reason.
    ///
    /// # Errors
    /// [`GpuError::LoaderMissing`], [`GpuError::LoaderTooOld`], [`GpuError::ValidationLayerMissing`],
    /// [`GpuError::NoDevice`], [`GpuError::NoMatchingDevice`], [`GpuError::NoSuitableDevice`], or an error
    /// that the driver reports.
    pub fn create(desc: &DeviceDesc) -> Result<Device> {
        let instance = Instance::create(&desc.application, desc.validation)?;
        // Every barrier uses synchronization2, so it is always required.
        let needed = Requirements { required: vec![Feature::Synchronization2], ..Requirements::default() };
        let requirements = needed.merge(&desc.requirements);
        let candidates = candidates(&instance.raw)?;
        let summaries: Vec<_> =
            candidates.iter().enumerate().map(|(index, each)| each.summary(index, &requirements)).collect();
        let (index, why_chosen) = choose(&summaries, desc.preference.as_deref())?;
        let candidate = &candidates[index];
        for (feature, benefit) in &summaries[index].missing_optional {
            tracing::info!("{} lacks the optional {feature}: {benefit}", candidate.name);
        }
        let optional = requirements.optional.iter().map(|(feature, _)| *feature);
        let enabled: BTreeSet<Feature> = requirements
            .required
            .iter()
            .copied()
            .chain(optional.filter(|feature| candidate.present.contains(feature)))
            .collect();
        let device = make_device(&instance.raw, candidate, &enabled)?;
        tracing::info!("device {} ({}): {why_chosen}", candidate.name, candidate.driver);
        let (debug_utils, labels) = (instance.debug_utils, instance.labels);
        Self::assemble(Parts {
            instance: instance.raw.clone(),
            log: instance.log().clone(),
            owned: Some(instance),
            candidate,
            device,
            queue: None,
            enabled,
            debug_utils,
            labels,
            pipeline_cache: vk::PipelineCache::null(),
            memory: None,
            memory_limit: None,
            api_version: candidate.api_version,
            why_chosen,
        })
    }

    /// Returns all devices of this machine, compared with requirements.
    ///
    /// # Errors
    /// Those of [`Device::create`], except the errors of the choice. Without any device the result is an
    /// empty list or [`GpuError::NoDevice`], depending on the loader.
    pub fn list(requirements: &Requirements) -> Result<Vec<DeviceSummary>> {
        let instance = Instance::create("rasray", false)?;
        let candidates = candidates(&instance.raw)?;
        Ok(candidates.iter().enumerate().map(|(index, each)| each.summary(index, requirements)).collect())
    }

    /// Assembles the shared state of a device; destroys the device again if it is owned and a part is
    /// missing.
    pub(crate) fn assemble(parts: Parts<'_>) -> Result<Device> {
        let Parts { instance, candidate, device, .. } = parts;
        let destroy = |owned: &Option<Instance>| {
            if owned.is_some() {
                // SAFETY: the device was made just now and nothing was made from it.
                unsafe { device.destroy_device(None) };
            }
        };
        let Some(family) = candidate.queue_family else {
            destroy(&parts.owned);
            return Err(GpuError::InvalidUse {
                name: candidate.name.clone(),
                reason: "the queue family given does not exist or cannot compute".to_owned(),
            });
        };
        let Some(commands) = Commands::load(&instance, &device, parts.api_version) else {
            destroy(&parts.owned);
            return Err(GpuError::FeatureNotEnabled {
                feature: Feature::Synchronization2,
                what: "recording barriers".to_owned(),
            });
        };
        let addresses = parts.enabled.contains(&Feature::BufferDeviceAddress);
        let memory = match parts.memory {
            Some(memory) => memory,
            None => match PooledMemory::new(&instance, candidate.physical, &device, addresses) {
                Ok(memory) => Arc::new(memory),
                Err(error) => {
                    destroy(&parts.owned);
                    return Err(error);
                }
            },
        };
        let queue = parts.queue.unwrap_or_else(|| {
            // SAFETY: the device was made with one queue of this family.
            unsafe { device.get_device_queue(family.index, 0) }
        });
        // SAFETY: the device belongs to the instance and is usable, so of version 1.2 or newer.
        let limits = unsafe { Limits::read(&instance, candidate.physical, family.timestamp_valid_bits) };
        #[cfg(feature = "fault-injection")]
        let limits = crate::faults::lower(limits);
        let names = parts.debug_utils.then(|| ash::ext::debug_utils::Device::new(&instance, &device));
        let labels = names.clone().filter(|_| parts.labels);
        let trees = parts.enabled.contains(&Feature::AccelerationStructure);
        let trees = trees.then(|| ash::khr::acceleration_structure::Device::new(&instance, &device));
        let core = Core {
            physical: candidate.physical,
            queue: Mutex::new(queue),
            queue_family: family.index,
            graphics: family.graphics,
            api_version: parts.api_version,
            commands,
            names,
            labels,
            trees,
            pipeline_cache: parts.pipeline_cache,
            pipelines: PipelineStore::default(),
            set_layouts: SetLayouts::default(),
            enabled: parts.enabled,
            identity: Identity {
                name: candidate.name.clone(),
                driver: candidate.driver.clone(),
                software: candidate.kind == crate::DeviceKind::Software,
                why_chosen: parts.why_chosen,
            },
            ledger: Ledger::new(parts.memory_limit),
            limits,
            log: parts.log,
            memory: Some(memory),
            owned: parts.owned,
            abandoned: AtomicBool::new(false),
            instance,
            device,
        };
        Ok(Device { core: Arc::new(core) })
    }

    /// Returns the name given by the driver.
    pub fn name(&self) -> &str {
        &self.core.identity.name
    }

    /// Returns name and version of the driver.
    pub fn driver(&self) -> &str {
        &self.core.identity.driver
    }

    /// Returns true for a software driver, whose timestamps are wrong around compute work.
    pub fn is_software(&self) -> bool {
        self.core.identity.software
    }

    /// Returns the reason why this device was chosen, in words.
    pub fn why_chosen(&self) -> &str {
        &self.core.identity.why_chosen
    }

    /// Returns true if a feature is enabled (required, or optional and present).
    pub fn has(&self, feature: Feature) -> bool {
        self.core.enabled.contains(&feature)
    }

    /// Returns true if all required features are enabled and the limits suffice, for checks before an object
    /// is made.
    pub fn supports(&self, requirements: &Requirements) -> bool {
        self.missing(requirements).next().is_none()
    }

    /// Returns the requirements that the device lacks, each as words of an error message; empty if it lacks
    /// none.
    pub fn lacks(&self, requirements: &Requirements) -> Vec<String> {
        self.missing(requirements).map(Missing::words).collect()
    }

    /// Checks that every requirement of `what` is enabled and within the device's limits.
    ///
    /// # Errors
    /// [`GpuError::FeatureNotEnabled`] for the first required feature that is not enabled,
    /// [`GpuError::LimitExceeded`] for too many storage buffers.
    pub fn require(&self, what: &str, requirements: &Requirements) -> Result<(), GpuError> {
        self.missing(requirements).next().map_or(Ok(()), |missing| Err(missing.error(what)))
    }

    /// Returns the features that are not enabled, then the limits that are too small.
    fn missing<'a>(&'a self, requirements: &'a Requirements) -> impl Iterator<Item = Missing> + 'a {
        let lacking = |feature: &Feature| !self.has(*feature);
        let features = requirements.required.iter().copied().filter(lacking).map(Missing::Feature);
        let (asked, limit) = (requirements.storage_buffers, self.limits().max_storage_buffers_per_stage);
        features.chain((asked > limit).then_some(Missing::StorageBuffers { asked, limit }))
    }

    /// Returns all enabled features.
    pub fn enabled(&self) -> Vec<Feature> {
        self.core.enabled.iter().copied().collect()
    }

    /// Returns the limits of the device.
    pub fn limits(&self) -> &Limits {
        &self.core.limits
    }

    /// Returns the Vulkan version in use, in Vulkan's packed format.
    pub fn api_version(&self) -> u32 {
        self.core.api_version
    }

    /// Returns the warnings and errors of the validation layer so far; empty without validation.
    pub fn validation_messages(&self) -> Vec<String> {
        self.core.log.messages()
    }

    /// Returns the log that [`Device::validation_messages`] reads. It outlives the device, so the destruction
    /// of the device can be checked as well.
    pub fn validation_log(&self) -> ValidationLog {
        self.core.log.clone()
    }

    /// Returns the bytes of memory in use by buffers of this device, including host-visible buffers.
    pub fn allocated_bytes(&self) -> u64 {
        self.core.ledger.allocated()
    }

    /// Returns the bytes that the memory source of this device has given out and not taken back, by its own
    /// count; `None` if it does not count. The number may exceed [`Device::allocated_bytes`] because of
    /// alignment.
    pub fn bytes_given_out(&self) -> Option<u64> {
        self.core.memory.as_ref().and_then(|memory| memory.bytes_given_out())
    }

    /// Returns the largest value of [`Device::allocated_bytes`] so far, or since
    /// [`Device::reset_peak_bytes`].
    pub fn peak_bytes(&self) -> u64 {
        self.core.ledger.peak()
    }

    /// Starts a new measurement of the peak.
    pub fn reset_peak_bytes(&self) {
        self.core.ledger.reset_peak();
    }

    /// Limits the memory of this device to `bytes`; `None` removes the limit. Existing allocations are not
    /// affected.
    pub fn set_memory_limit(&self, bytes: Option<u64>) {
        self.core.ledger.set_limit(bytes);
    }

    /// Returns the Vulkan device. Objects made from it must be destroyed before the last handle of this value
    /// is.
    pub fn raw(&self) -> &ash::Device {
        &self.core.device
    }

    /// Returns the Vulkan instance.
    pub fn raw_instance(&self) -> &ash::Instance {
        &self.core.instance
    }

    /// Returns the Vulkan physical device.
    pub fn raw_physical(&self) -> vk::PhysicalDevice {
        self.core.physical
    }

    /// Returns the queue. Callers that submit to it must not do so while [`Device::submit`] or a related
    /// function runs.
    pub fn raw_queue(&self) -> vk::Queue {
        *self.core.queue.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    /// Returns the family of the queue.
    pub fn queue_family(&self) -> u32 {
        self.core.queue_family
    }
}

/// Parts that a device is assembled from.
pub(crate) struct Parts<'a> {
    pub(crate) instance: ash::Instance,
    pub(crate) owned: Option<Instance>,
    pub(crate) log: ValidationLog,
    pub(crate) candidate: &'a Candidate,
    pub(crate) device: ash::Device,
    /// Queue of the device; if absent, queue 0 of the candidate's family.
    pub(crate) queue: Option<vk::Queue>,
    pub(crate) enabled: BTreeSet<Feature>,
    pub(crate) debug_utils: bool,
    /// True if passes get labels when `debug_utils` is enabled.
    pub(crate) labels: bool,
    pub(crate) pipeline_cache: vk::PipelineCache,
    pub(crate) memory: Option<Arc<dyn crate::Memory>>,
    pub(crate) memory_limit: Option<u64>,
    pub(crate) api_version: u32,
    pub(crate) why_chosen: String,
}

/// Makes a device with one queue and exactly the given features.
fn make_device(
    instance: &ash::Instance,
    candidate: &Candidate,
    enabled: &BTreeSet<Feature>,
) -> Result<ash::Device> {
    let mut extensions: BTreeSet<&CStr> =
        enabled.iter().flat_map(|feature| feature.extensions(candidate.api_version)).copied().collect();
    let portability = ash::khr::portability_subset::NAME;
    if candidate.has_extension(portability) {
        // Vulkan requires this extension to be enabled if the device has it.
        extensions.insert(portability);
    }
    let names: Vec<_> = extensions.iter().map(|name| name.as_ptr()).collect();
    let mut structs = FeatureStructs::default();
    for feature in enabled {
        if let Some(switch) = feature.switch(&mut structs) {
            *switch = vk::TRUE;
        }
    }
    let Some(family) = candidate.queue_family else {
        return Err(GpuError::NoDevice);
    };
    let priorities = [1.0];
    let queues =
        [vk::DeviceQueueCreateInfo::default().queue_family_index(family.index).queue_priorities(&priorities)];
    // The chain may contain only structures of enabled extensions.
    let is_enabled = |name: &CStr| extensions.contains(name);
    structs
        .with_chain(candidate.api_version, &is_enabled, |chain| {
            let info = vk::DeviceCreateInfo::default()
                .queue_create_infos(&queues)
                .enabled_extension_names(&names)
                .push_next(chain);
            // SAFETY: the physical device belongs to the instance and has the requested queue family,
            // extensions and features, and all pointers live until the call returns.
            unsafe { instance.create_device(candidate.physical, &info, None) }
        })
        .during("vkCreateDevice", &candidate.name)
}

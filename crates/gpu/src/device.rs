//! The device: chosen and made here (or handed in, see [`crate::RawDevice`]).

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

/// Choice and settings of a device to be made.
#[derive(Debug, Clone)]
pub struct DeviceDesc {
    /// Requirements, of features that it must and may have. Nothing else is enabled.
    pub requirements: Requirements,
    /// Index or part of the name; without it the best suitable device is taken.
    pub preference: Option<String>,
    /// True if the validation layer watches; an error if it is not installed.
    pub validation: bool,
    /// Name of the application, shown by tools.
    pub application: String,
}

impl Default for DeviceDesc {
    /// The device floor, no preference, no validation.
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
    /// Makes the best device that has what is required: discrete before integrated before virtual before
    /// software. Logs which one it is and why.
    ///
    /// # Errors
    /// [`GpuError::LoaderMissing`], [`GpuError::LoaderTooOld`], [`GpuError::ValidationLayerMissing`],
    /// [`GpuError::NoDevice`], [`GpuError::NoMatchingDevice`], [`GpuError::NoSuitableDevice`], or what the
    /// driver reports.
    pub fn create(desc: &DeviceDesc) -> Result<Device> {
        let instance = Instance::create(&desc.application, desc.validation)?;
        // synchronization2 is used by every barrier, so it is required whatever was asked for.
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

    /// All devices of this machine, held against requirements.
    ///
    /// # Errors
    /// As [`Device::create`], but for the choice. No device at all is an empty list or
    /// [`GpuError::NoDevice`], depending on the loader.
    pub fn list(requirements: &Requirements) -> Result<Vec<DeviceSummary>> {
        let instance = Instance::create("rasray", false)?;
        let candidates = candidates(&instance.raw)?;
        Ok(candidates.iter().enumerate().map(|(index, each)| each.summary(index, requirements)).collect())
    }

    /// Puts the shared part together; destroys the device again if it is owned and something is missing.
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

    /// Name given by the driver.
    pub fn name(&self) -> &str {
        &self.core.identity.name
    }

    /// Name and version of the driver.
    pub fn driver(&self) -> &str {
        &self.core.identity.driver
    }

    /// True for a software driver, whose timestamps are wrong around compute work.
    pub fn is_software(&self) -> bool {
        self.core.identity.software
    }

    /// Why this device was chosen, in words.
    pub fn why_chosen(&self) -> &str {
        &self.core.identity.why_chosen
    }

    /// True if a feature is enabled (required, or optional and present).
    pub fn has(&self, feature: Feature) -> bool {
        self.core.enabled.contains(&feature)
    }

    /// True if everything required is enabled and within its limits, asked before anything is made.
    pub fn supports(&self, requirements: &Requirements) -> bool {
        self.missing(requirements).next().is_none()
    }

    /// Returns the requirements that it lacks, each as words of an error message; nothing where all is there.
    pub fn lacks(&self, requirements: &Requirements) -> Vec<String> {
        self.missing(requirements).map(Missing::words).collect()
    }

    /// That everything `what` requires is enabled and within the device's limits.
    ///
    /// # Errors
    /// [`GpuError::FeatureNotEnabled`] for the first required feature that is not,
    /// [`GpuError::LimitExceeded`] for too many storage buffers.
    pub fn require(&self, what: &str, requirements: &Requirements) -> Result<(), GpuError> {
        self.missing(requirements).next().map_or(Ok(()), |missing| Err(missing.error(what)))
    }

    /// Features that are not enabled, then limits that are too small.
    fn missing<'a>(&'a self, requirements: &'a Requirements) -> impl Iterator<Item = Missing> + 'a {
        let lacking = |feature: &Feature| !self.has(*feature);
        let features = requirements.required.iter().copied().filter(lacking).map(Missing::Feature);
        let (asked, limit) = (requirements.storage_buffers, self.limits().max_storage_buffers_per_stage);
        features.chain((asked > limit).then_some(Missing::StorageBuffers { asked, limit }))
    }

    /// All enabled features.
    pub fn enabled(&self) -> Vec<Feature> {
        self.core.enabled.iter().copied().collect()
    }

    /// Limits of the device.
    pub fn limits(&self) -> &Limits {
        &self.core.limits
    }

    /// Vulkan version in use, packed as Vulkan packs it.
    pub fn api_version(&self) -> u32 {
        self.core.api_version
    }

    /// Warnings and errors of the validation layer so far; empty without validation.
    pub fn validation_messages(&self) -> Vec<String> {
        self.core.log.messages()
    }

    /// The list behind [`Device::validation_messages`]; it outlives the device, so that its destruction can
    /// be checked as well.
    pub fn validation_log(&self) -> ValidationLog {
        self.core.log.clone()
    }

    /// Bytes of memory in use by buffers of this device, host-visible ones included.
    pub fn allocated_bytes(&self) -> u64 {
        self.core.ledger.allocated()
    }

    /// Bytes that the memory source of this device has given out and not taken back, by its own books; `None`
    /// where it keeps none. It may exceed [`Device::allocated_bytes`] by alignment.
    pub fn bytes_given_out(&self) -> Option<u64> {
        self.core.memory.as_ref().and_then(|memory| memory.bytes_given_out())
    }

    /// Largest value of [`Device::allocated_bytes`] so far, or since [`Device::reset_peak_bytes`].
    pub fn peak_bytes(&self) -> u64 {
        self.core.ledger.peak()
    }

    /// Begins a new measurement of the peak.
    pub fn reset_peak_bytes(&self) {
        self.core.ledger.reset_peak();
    }

    /// Limits the memory of this device to `bytes`; `None` lifts the limit. What is allocated stays.
    pub fn set_memory_limit(&self, bytes: Option<u64>) {
        self.core.ledger.set_limit(bytes);
    }

    /// The Vulkan device. What is made from it must be destroyed before the last handle of this value is.
    pub fn raw(&self) -> &ash::Device {
        &self.core.device
    }

    /// The Vulkan instance.
    pub fn raw_instance(&self) -> &ash::Instance {
        &self.core.instance
    }

    /// The Vulkan physical device.
    pub fn raw_physical(&self) -> vk::PhysicalDevice {
        self.core.physical
    }

    /// The queue. Whoever submits to it must not do so while [`Device::submit`] and its relatives run.
    pub fn raw_queue(&self) -> vk::Queue {
        *self.core.queue.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    /// The family of the queue.
    pub fn queue_family(&self) -> u32 {
        self.core.queue_family
    }
}

/// Parts that a device is put together from.
pub(crate) struct Parts<'a> {
    pub(crate) instance: ash::Instance,
    pub(crate) owned: Option<Instance>,
    pub(crate) log: ValidationLog,
    pub(crate) candidate: &'a Candidate,
    pub(crate) device: ash::Device,
    /// Without it queue 0 of the family of the candidate.
    pub(crate) queue: Option<vk::Queue>,
    pub(crate) enabled: BTreeSet<Feature>,
    pub(crate) debug_utils: bool,
    /// True if passes have labels, where `debug_utils` is enabled.
    pub(crate) labels: bool,
    pub(crate) pipeline_cache: vk::PipelineCache,
    pub(crate) memory: Option<Arc<dyn crate::Memory>>,
    pub(crate) memory_limit: Option<u64>,
    pub(crate) api_version: u32,
    pub(crate) why_chosen: String,
}

/// Makes a device with one queue and exactly the features given.
fn make_device(
    instance: &ash::Instance,
    candidate: &Candidate,
    enabled: &BTreeSet<Feature>,
) -> Result<ash::Device> {
    let mut extensions: BTreeSet<&CStr> =
        enabled.iter().flat_map(|feature| feature.extensions(candidate.api_version)).copied().collect();
    let portability = ash::khr::portability_subset::NAME;
    if candidate.has_extension(portability) {
        // Vulkan demands it wherever it is offered.
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
    // Only extensions that are enabled may have their structure in the chain.
    let is_enabled = |name: &CStr| extensions.contains(name);
    structs
        .with_chain(candidate.api_version, &is_enabled, |chain| {
            let info = vk::DeviceCreateInfo::default()
                .queue_create_infos(&queues)
                .enabled_extension_names(&names)
                .push_next(chain);
            // SAFETY: the physical device belongs to the instance, has the queue family, extensions and
            // features asked for, and all pointers live until the call returns.
            unsafe { instance.create_device(candidate.physical, &info, None) }
        })
        .during("vkCreateDevice", &candidate.name)
}

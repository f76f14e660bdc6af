//! Choice of a device: the properties of every device, and the selection of one.

use std::collections::BTreeSet;
use std::ffi::{CStr, CString};
use std::fmt;

use ash::vk;

use crate::error::{During, GpuError, Result};
use crate::features::{Feature, FeatureStructs};
use crate::requirements::Requirements;

/// Kind of a device, in order of preference.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum DeviceKind {
    /// A GPU with its own memory.
    Discrete,
    /// A GPU that shares the memory of the processor.
    Integrated,
    /// A GPU of a virtual machine.
    Virtual,
    /// A software driver.
    Software,
    /// Any other kind of device.
    Other,
}

impl DeviceKind {
    fn of(kind: vk::PhysicalDeviceType) -> Self {
        match kind {
            vk::PhysicalDeviceType::DISCRETE_GPU => Self::Discrete,
            vk::PhysicalDeviceType::INTEGRATED_GPU => Self::Integrated,
            vk::PhysicalDeviceType::VIRTUAL_GPU => Self::Virtual,
            vk::PhysicalDeviceType::CPU => Self::Software,
            _ => Self::Other,
        }
    }
}

impl fmt::Display for DeviceKind {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Discrete => "discrete",
            Self::Integrated => "integrated",
            Self::Virtual => "virtual",
            Self::Software => "software",
            Self::Other => "other",
        })
    }
}

/// Properties of one device of this machine, compared with requirements.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct DeviceSummary {
    /// Index in the list of devices; also a valid preference.
    pub index: usize,
    /// Name given by the driver.
    pub name: String,
    /// Name and version of the driver; empty if the device is older than Vulkan 1.2.
    pub driver: String,
    /// Kind of the device.
    pub kind: DeviceKind,
    /// Vulkan version as major, minor, patch.
    pub api_version: [u32; 3],
    /// True if the device has the Vulkan version (1.2) and the compute queue that this crate always needs.
    pub usable: bool,
    /// Features of [`Feature::ALL`] that the device has.
    pub features: Vec<Feature>,
    /// Required features that the device lacks.
    pub missing: Vec<Feature>,
    /// Optional features that the device lacks, with the benefit of each.
    pub missing_optional: Vec<(Feature, &'static str)>,
}

impl DeviceSummary {
    /// Returns true if the device fulfils the requirements that it was compared with.
    pub fn is_suitable(&self) -> bool {
        self.usable && self.missing.is_empty()
    }
}

impl fmt::Display for DeviceSummary {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [major, minor, patch] = self.api_version;
        write!(formatter, "  {}: {} ({}, Vulkan {major}.{minor}.{patch})", self.index, self.name, self.kind)?;
        if !self.usable {
            write!(formatter, " lacks Vulkan 1.2 with a compute queue")?;
        } else if !self.missing.is_empty() {
            let names: Vec<_> = self.missing.iter().map(|feature| feature.name()).collect();
            write!(formatter, " lacks {}", names.join(", "))?;
        }
        Ok(())
    }
}

/// Queue family that all commands run on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct QueueFamily {
    pub(crate) index: u32,
    pub(crate) graphics: bool,
    pub(crate) timestamp_valid_bits: u32,
}

/// A physical device with its properties.
pub(crate) struct Candidate {
    pub(crate) physical: vk::PhysicalDevice,
    pub(crate) name: String,
    pub(crate) driver: String,
    pub(crate) kind: DeviceKind,
    pub(crate) api_version: u32,
    pub(crate) queue_family: Option<QueueFamily>,
    pub(crate) present: BTreeSet<Feature>,
    extensions: BTreeSet<CString>,
}

impl Candidate {
    /// Reads the properties of one device. `queue_family` fixes the queue family; without it the best family
    /// is chosen.
    ///
    /// # Safety
    /// `physical` belongs to `instance`.
    pub(crate) unsafe fn inspect(
        instance: &ash::Instance,
        physical: vk::PhysicalDevice,
        queue_family: Option<u32>,
    ) -> Result<Self> {
        // SAFETY: the caller guarantees that the device belongs to the instance; the same holds for all calls
        // below.
        let properties = unsafe { instance.get_physical_device_properties(physical) };
        let name = properties
            .device_name_as_c_str()
            .map_or_else(|_| "unnamed device".to_owned(), |name| name.to_string_lossy().into_owned());
        // SAFETY: see above.
        let extensions = unsafe { instance.enumerate_device_extension_properties(physical) }
            .during("vkEnumerateDeviceExtensionProperties", &name)?
            .iter()
            .filter_map(|each| each.extension_name_as_c_str().ok().map(CStr::to_owned))
            .collect();
        // SAFETY: see above.
        let families = unsafe { instance.get_physical_device_queue_family_properties(physical) };
        let mut candidate = Self {
            physical,
            name,
            driver: String::new(),
            kind: DeviceKind::of(properties.device_type),
            api_version: properties.api_version,
            queue_family: choose_family(&families, queue_family),
            present: BTreeSet::new(),
            extensions,
        };
        if candidate.api_version >= vk::API_VERSION_1_2 {
            // SAFETY: see above; the version was checked.
            unsafe { candidate.inspect_version_1_2(instance) };
        }
        #[cfg(feature = "fault-injection")]
        candidate.hide();
        Ok(candidate)
    }

    /// Reads driver and features.
    ///
    /// # Safety
    /// The device belongs to `instance` and supports Vulkan 1.2.
    unsafe fn inspect_version_1_2(&mut self, instance: &ash::Instance) {
        let mut subgroup = vk::PhysicalDeviceSubgroupProperties::default();
        let mut driver = vk::PhysicalDeviceDriverProperties::default();
        let mut properties =
            vk::PhysicalDeviceProperties2::default().push_next(&mut subgroup).push_next(&mut driver);
        // SAFETY: the caller guarantees device and version; both structures are core in 1.2.
        unsafe { instance.get_physical_device_properties2(self.physical, &mut properties) };
        let text = |name: std::result::Result<&CStr, _>| {
            name.map_or_else(|_| String::new(), |name: &CStr| name.to_string_lossy().into_owned())
        };
        self.driver =
            format!("{} {}", text(driver.driver_name_as_c_str()), text(driver.driver_info_as_c_str()));
        self.driver = self.driver.trim().to_owned();

        let mut structs = FeatureStructs::default();
        structs.with_chain(self.api_version, &|name| self.extensions.contains(name), |chain| {
            // SAFETY: the chain holds structures that this device knows.
            unsafe { instance.get_physical_device_features2(self.physical, chain) };
        });
        let wanted = vk::SubgroupFeatureFlags::BASIC
            | vk::SubgroupFeatureFlags::VOTE
            | vk::SubgroupFeatureFlags::BALLOT
            | vk::SubgroupFeatureFlags::SHUFFLE
            | vk::SubgroupFeatureFlags::ARITHMETIC;
        let subgroups = subgroup.supported_operations.contains(wanted)
            && subgroup.supported_stages.contains(vk::ShaderStageFlags::COMPUTE);
        let family = self.queue_family;
        for feature in Feature::ALL {
            let switched = feature.switch(&mut structs).is_none_or(|switch| *switch == vk::TRUE);
            let extended =
                feature.extensions(self.api_version).iter().all(|name| self.extensions.contains(*name));
            let queued = match feature {
                Feature::TimestampQueries => family.is_some_and(|family| family.timestamp_valid_bits > 0),
                Feature::SubgroupOperations => subgroups,
                _ => !feature.needs_graphics() || family.is_some_and(|family| family.graphics),
            };
            if switched && extended && queued {
                self.present.insert(feature);
            }
        }
    }

    /// Removes the features that a test hides.
    #[cfg(feature = "fault-injection")]
    fn hide(&mut self) {
        self.present.retain(|feature| !crate::faults::hides(*feature));
        if let (true, Some(family)) =
            (crate::faults::hides(Feature::TimestampQueries), self.queue_family.as_mut())
        {
            family.timestamp_valid_bits = 0;
        }
    }

    /// Returns true if the device has this extension.
    pub(crate) fn has_extension(&self, name: &CStr) -> bool {
        self.extensions.contains(name)
    }

    /// Returns true if version and queue suffice for this crate.
    pub(crate) fn is_usable(&self) -> bool {
        self.api_version >= vk::API_VERSION_1_2 && self.queue_family.is_some()
    }

    /// Returns the public description, compared with requirements.
    pub(crate) fn summary(&self, index: usize, requirements: &Requirements) -> DeviceSummary {
        let lacks = |feature: &Feature| !self.present.contains(feature);
        DeviceSummary {
            index,
            name: self.name.clone(),
            driver: self.driver.clone(),
            kind: self.kind,
            api_version: [
                vk::api_version_major(self.api_version),
                vk::api_version_minor(self.api_version),
                vk::api_version_patch(self.api_version),
            ],
            usable: self.is_usable(),
            features: self.present.iter().copied().collect(),
            missing: requirements.required.iter().copied().filter(|feature| lacks(feature)).collect(),
            missing_optional: requirements
                .optional
                .iter()
                .copied()
                .filter(|(feature, _)| lacks(feature))
                .collect(),
        }
    }
}

/// Chooses a queue family that supports compute, preferably one that supports graphics as well.
fn choose_family(families: &[vk::QueueFamilyProperties], fixed: Option<u32>) -> Option<QueueFamily> {
    let offer = |index: usize, family: &vk::QueueFamilyProperties| {
        let computes = family.queue_flags.contains(vk::QueueFlags::COMPUTE) && family.queue_count > 0;
        computes.then_some(QueueFamily {
            index: u32::try_from(index).ok()?,
            graphics: family.queue_flags.contains(vk::QueueFlags::GRAPHICS),
            timestamp_valid_bits: family.timestamp_valid_bits,
        })
    };
    if let Some(fixed) = fixed {
        let index = usize::try_from(fixed).ok()?;
        return families.get(index).and_then(|family| offer(index, family));
    }
    let mut offers = families.iter().enumerate().filter_map(|(index, family)| offer(index, family));
    let first = offers.next()?;
    if first.graphics { Some(first) } else { offers.find(|family| family.graphics).or(Some(first)) }
}

/// Returns all devices of an instance.
pub(crate) fn candidates(instance: &ash::Instance) -> Result<Vec<Candidate>> {
    // SAFETY: the instance is alive.
    let physical = unsafe { instance.enumerate_physical_devices() }
        .during("vkEnumeratePhysicalDevices", "the list of devices")?;
    // SAFETY: the devices were just listed by this instance.
    physical.into_iter().map(|physical| unsafe { Candidate::inspect(instance, physical, None) }).collect()
}

/// Returns the index of the best device, and the reason of the choice.
pub(crate) fn choose(summaries: &[DeviceSummary], preference: Option<&str>) -> Result<(usize, String)> {
    if summaries.is_empty() {
        return Err(GpuError::NoDevice);
    }
    let list = |chosen: &[&DeviceSummary]| {
        chosen.iter().map(|summary| summary.to_string()).collect::<Vec<_>>().join("\n")
    };
    let all: Vec<&DeviceSummary> = summaries.iter().collect();
    let matching = match preference {
        None => all.clone(),
        Some(preference) => matching(&all, preference),
    };
    if matching.is_empty() {
        let preference = preference.unwrap_or_default().to_owned();
        return Err(GpuError::NoMatchingDevice { preference, devices: list(&all) });
    }
    let suitable: Vec<_> = matching.iter().copied().filter(|summary| summary.is_suitable()).collect();
    let Some(best) = suitable.iter().min_by_key(|summary| (summary.kind, summary.index)) else {
        return Err(GpuError::NoSuitableDevice { devices: list(&matching) });
    };
    let why = match (preference, suitable.len()) {
        (Some(preference), _) => format!("{} device, asked for as `{preference}`", best.kind),
        (None, 1) if summaries.len() == 1 => format!("{} device, the only one", best.kind),
        (None, 1) => {
            format!("{} device, the only one of {} with what is required", best.kind, summaries.len())
        }
        (None, count) => format!("{} device, preferred among {count} with what is required", best.kind),
    };
    Ok((best.index, why))
}

/// Returns the device whose index is the preference; if there is none, those whose name contains it, ignoring
/// case.
fn matching<'a>(summaries: &[&'a DeviceSummary], preference: &str) -> Vec<&'a DeviceSummary> {
    let preference = preference.trim();
    if let Some(found) =
        preference.parse::<usize>().ok().and_then(|index| summaries.iter().find(|each| each.index == index))
    {
        return vec![*found];
    }
    let wanted = preference.to_lowercase();
    if wanted.is_empty() {
        return Vec::new();
    }
    summaries.iter().copied().filter(|summary| summary.name.to_lowercase().contains(&wanted)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn summary(index: usize, name: &str, kind: DeviceKind, missing: &[Feature]) -> DeviceSummary {
        DeviceSummary {
            index,
            name: name.to_owned(),
            driver: String::new(),
            kind,
            api_version: [1, 3, 0],
            usable: true,
            features: Vec::new(),
            missing: missing.to_vec(),
            missing_optional: Vec::new(),
        }
    }

    #[test]
    fn a_discrete_device_is_preferred_unless_it_lacks_something() {
        let mut devices = vec![
            summary(0, "llvmpipe", DeviceKind::Software, &[]),
            summary(1, "Integrated 630", DeviceKind::Integrated, &[]),
            summary(2, "Discrete 4090", DeviceKind::Discrete, &[]),
        ];
        assert_eq!(choose(&devices, None).map(|(index, _)| index).ok(), Some(2));
        devices[2].missing.push(Feature::ScalarBlockLayout);
        assert_eq!(choose(&devices, None).map(|(index, _)| index).ok(), Some(1));
    }

    #[test]
    fn a_preference_is_an_index_or_a_part_of_the_name() {
        let devices = vec![
            summary(0, "llvmpipe", DeviceKind::Software, &[]),
            summary(1, "Discrete 4090", DeviceKind::Discrete, &[]),
        ];
        for (preference, expected) in [("0", 0), ("LLVM", 0), ("4090", 1), (" 1 ", 1)] {
            assert_eq!(choose(&devices, Some(preference)).map(|(index, _)| index).ok(), Some(expected));
        }
        let error = choose(&devices, Some("voodoo")).expect_err("nothing has that name").to_string();
        assert!(error.contains("voodoo") && error.contains("llvmpipe") && error.contains("4090"), "{error}");
        assert!(choose(&devices, Some("")).is_err(), "an empty preference matches nothing");
    }

    #[test]
    fn the_error_says_what_each_device_lacks() {
        let devices = vec![
            summary(0, "old", DeviceKind::Discrete, &[Feature::Synchronization2]),
            summary(1, "older", DeviceKind::Discrete, &[Feature::ScalarBlockLayout]),
        ];
        let error = choose(&devices, None).expect_err("none is suitable").to_string();
        assert!(error.contains("old (discrete, Vulkan 1.3.0) lacks synchronization2"), "{error}");
        assert!(error.contains("scalarBlockLayout"), "{error}");
        assert!(matches!(choose(&[], None), Err(GpuError::NoDevice)));
    }

    #[test]
    fn graphics_with_compute_is_preferred() {
        let family =
            |flags| vk::QueueFamilyProperties { queue_flags: flags, queue_count: 1, ..Default::default() };
        let families = [
            family(vk::QueueFlags::TRANSFER),
            family(vk::QueueFlags::COMPUTE),
            family(vk::QueueFlags::COMPUTE | vk::QueueFlags::GRAPHICS),
        ];
        assert_eq!(choose_family(&families, None).map(|family| family.index), Some(2));
        assert_eq!(choose_family(&families[..2], None).map(|family| family.graphics), Some(false));
        assert!(choose_family(&families, Some(0)).is_none());
    }
}

//! Device features as data: what is required, what is optional and what it buys.

use std::ffi::CStr;
use std::fmt;

use ash::vk;

use crate::error::GpuError;

/// A capability of a device that must be asked for before it is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Feature {
    /// `layout(scalar)` buffers (`scalarBlockLayout`).
    ScalarBlockLayout,
    /// Barriers of [`crate::Recorder`] (`synchronization2`, Vulkan 1.3 or the extension).
    Synchronization2,
    /// Raster pipelines without render passes (`dynamicRendering`, Vulkan 1.3 or the extension).
    DynamicRendering,
    /// Storage buffer writes from fragment shaders (`fragmentStoresAndAtomics`).
    FragmentStoresAndAtomics,
    /// Several views in one draw (`multiview`).
    Multiview,
    /// Coverage of every touched pixel by the hardware (`VK_EXT_conservative_rasterization`).
    ConservativeRasterization,
    /// Buffers reached by 64-bit address (`bufferDeviceAddress`).
    BufferDeviceAddress,
    /// Basic, vote, ballot, shuffle and arithmetic subgroup operations in compute shaders.
    SubgroupOperations,
    /// Timestamps on the queue. Nothing has to be enabled for it: pools are reset in the command buffer.
    TimestampQueries,
}

impl Feature {
    /// Every feature this crate knows.
    pub const ALL: [Feature; 9] = [
        Self::ScalarBlockLayout,
        Self::Synchronization2,
        Self::DynamicRendering,
        Self::FragmentStoresAndAtomics,
        Self::Multiview,
        Self::ConservativeRasterization,
        Self::BufferDeviceAddress,
        Self::SubgroupOperations,
        Self::TimestampQueries,
    ];

    /// The name Vulkan has for it, for messages and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::ScalarBlockLayout => "scalarBlockLayout",
            Self::Synchronization2 => "synchronization2",
            Self::DynamicRendering => "dynamicRendering",
            Self::FragmentStoresAndAtomics => "fragmentStoresAndAtomics",
            Self::Multiview => "multiview",
            Self::ConservativeRasterization => "VK_EXT_conservative_rasterization",
            Self::BufferDeviceAddress => "bufferDeviceAddress",
            Self::SubgroupOperations => "subgroup operations",
            Self::TimestampQueries => "timestamp queries",
        }
    }

    /// The extension that brings this feature to a device of the given API version; `None` where it is core.
    pub(crate) fn extension(self, api_version: u32) -> Option<&'static CStr> {
        match self {
            Self::Synchronization2 if api_version < vk::API_VERSION_1_3 => {
                Some(ash::khr::synchronization2::NAME)
            }
            Self::DynamicRendering if api_version < vk::API_VERSION_1_3 => {
                Some(ash::khr::dynamic_rendering::NAME)
            }
            Self::ConservativeRasterization => Some(ash::ext::conservative_rasterization::NAME),
            _ => None,
        }
    }

    /// Whether the feature is of no use without a graphics queue.
    pub(crate) fn needs_graphics(self) -> bool {
        matches!(
            self,
            Self::DynamicRendering
                | Self::FragmentStoresAndAtomics
                | Self::Multiview
                | Self::ConservativeRasterization
        )
    }

    /// The switch of the feature; `None` where Vulkan has none.
    pub(crate) fn switch(self, structs: &mut FeatureStructs) -> Option<&mut vk::Bool32> {
        match self {
            Self::ScalarBlockLayout => Some(&mut structs.v12.scalar_block_layout),
            Self::Synchronization2 => Some(&mut structs.synchronization2.synchronization2),
            Self::DynamicRendering => Some(&mut structs.dynamic_rendering.dynamic_rendering),
            Self::FragmentStoresAndAtomics => Some(&mut structs.core.fragment_stores_and_atomics),
            Self::Multiview => Some(&mut structs.v11.multiview),
            Self::BufferDeviceAddress => Some(&mut structs.v12.buffer_device_address),
            Self::ConservativeRasterization | Self::SubgroupOperations | Self::TimestampQueries => None,
        }
    }
}

impl fmt::Display for Feature {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

/// What a device must have, and what it may have.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Requirements {
    /// A device without one of these is not chosen.
    pub required: Vec<Feature>,
    /// Enabled where present; with each what it buys.
    pub optional: Vec<(Feature, &'static str)>,
    /// Storage buffers that one shader stage must be able to use, all sets together; 0 where any device will do.
    pub storage_buffers: u32,
}

impl Requirements {
    /// The device floor: scalar block layout, synchronization2 and dynamic rendering.
    pub fn floor() -> Self {
        Self {
            required: vec![Feature::ScalarBlockLayout, Feature::Synchronization2, Feature::DynamicRendering],
            ..Self::default()
        }
    }

    /// These requirements and the other ones. What either requires is required, and no longer optional.
    #[must_use]
    pub fn merge(mut self, other: &Requirements) -> Self {
        self.required.extend_from_slice(&other.required);
        self.required.sort_unstable();
        self.required.dedup();
        self.optional.extend_from_slice(&other.optional);
        self.optional.sort_unstable();
        self.optional.dedup();
        let required = &self.required;
        self.optional.retain(|(feature, _)| !required.contains(feature));
        self.storage_buffers = self.storage_buffers.max(other.storage_buffers);
        self
    }
}

/// Something of [`Requirements`] that a device lacks.
pub(crate) enum Missing {
    /// A feature that is not enabled.
    Feature(Feature),
    /// More storage buffers than a shader stage can reach.
    StorageBuffers { asked: u32, limit: u32 },
}

impl Missing {
    /// What is lacking, as words of a message.
    pub(crate) fn words(self) -> String {
        match self {
            Self::Feature(feature) => feature.name().to_owned(),
            Self::StorageBuffers { asked, limit } => {
                format!("{asked} storage buffers per shader stage (it has {limit})")
            }
        }
    }

    /// The error of `what`, which cannot do without it.
    pub(crate) fn error(self, what: &str) -> GpuError {
        match self {
            Self::Feature(feature) => GpuError::FeatureNotEnabled { feature, what: what.to_owned() },
            Self::StorageBuffers { asked, limit } => GpuError::LimitExceeded {
                name: what.to_owned(),
                what: "the number of storage buffers that a shader stage uses",
                asked: asked.into(),
                limit: limit.into(),
            },
        }
    }
}

/// The Vulkan structures that hold the switches.
#[derive(Default)]
pub(crate) struct FeatureStructs {
    core: vk::PhysicalDeviceFeatures,
    v11: vk::PhysicalDeviceVulkan11Features<'static>,
    v12: vk::PhysicalDeviceVulkan12Features<'static>,
    synchronization2: vk::PhysicalDeviceSynchronization2Features<'static>,
    dynamic_rendering: vk::PhysicalDeviceDynamicRenderingFeatures<'static>,
}

impl FeatureStructs {
    /// Calls `body` with the chain of all structures that a device of this version and with these extensions
    /// knows.
    pub(crate) fn with_chain<R>(
        &mut self,
        api_version: u32,
        has_extension: &dyn Fn(&CStr) -> bool,
        body: impl FnOnce(&mut vk::PhysicalDeviceFeatures2<'_>) -> R,
    ) -> R {
        let knows = |feature: Feature| feature.extension(api_version).is_none_or(has_extension);
        let mut chain = vk::PhysicalDeviceFeatures2::default().features(self.core);
        if api_version >= vk::API_VERSION_1_2 {
            chain = chain.push_next(&mut self.v11).push_next(&mut self.v12);
        }
        if knows(Feature::Synchronization2) {
            chain = chain.push_next(&mut self.synchronization2);
        }
        if knows(Feature::DynamicRendering) {
            chain = chain.push_next(&mut self.dynamic_rendering);
        }
        let answer = body(&mut chain);
        self.core = chain.features;
        answer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn merging_prefers_required_over_optional_and_removes_duplicates() {
        let first = Requirements {
            required: vec![Feature::BufferDeviceAddress],
            optional: vec![(Feature::Multiview, "one draw for all views")],
            storage_buffers: 12,
        };
        let second = Requirements {
            required: vec![Feature::Multiview, Feature::BufferDeviceAddress],
            optional: vec![
                (Feature::BufferDeviceAddress, "large pools"),
                (Feature::FragmentStoresAndAtomics, "raster builds"),
            ],
            storage_buffers: 8,
        };
        let both = first.merge(&second);
        assert_eq!(both.required, [Feature::Multiview, Feature::BufferDeviceAddress]);
        assert_eq!(both.optional, [(Feature::FragmentStoresAndAtomics, "raster builds")]);
        assert_eq!(both.storage_buffers, 12);
    }

    #[test]
    fn every_feature_has_its_own_name_and_switch() {
        let mut names: Vec<_> = Feature::ALL.iter().map(|feature| feature.name()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), Feature::ALL.len());
        let mut structs = FeatureStructs::default();
        let mut switches: Vec<usize> = Vec::new();
        for feature in Feature::ALL {
            switches.extend(feature.switch(&mut structs).map(|switch| std::ptr::from_mut(switch) as usize));
        }
        let count = switches.len();
        switches.sort_unstable();
        switches.dedup();
        assert_eq!(switches.len(), count, "two features share a switch");
    }
}

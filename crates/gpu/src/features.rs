//! Device features as data: their names, extensions and switches.

use std::ffi::CStr;
use std::fmt;

use ash::vk;

/// A capability of a device that must be requested before it is used.
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
    /// Rasterization that covers every pixel a triangle touches (`VK_EXT_conservative_rasterization`).
    ConservativeRasterization,
    /// Access to buffers by 64-bit address (`bufferDeviceAddress`).
    BufferDeviceAddress,
    /// Acceleration structures that the driver builds (`VK_KHR_acceleration_structure`); also needs
    /// [`Feature::BufferDeviceAddress`].
    AccelerationStructure,
    /// Shaders that traverse acceleration structures of the driver (`VK_KHR_ray_query`).
    RayQuery,
    /// 64-bit integers in shaders (`shaderInt64`).
    Int64,
    /// Basic, vote, ballot, shuffle and arithmetic subgroup operations in compute shaders.
    SubgroupOperations,
    /// Timestamps on the queue. It needs no Vulkan feature, because pools are reset in the command buffer.
    TimestampQueries,
}

impl Feature {
    /// All features that this crate knows.
    pub const ALL: [Feature; 12] = [
        Self::ScalarBlockLayout,
        Self::Synchronization2,
        Self::DynamicRendering,
        Self::FragmentStoresAndAtomics,
        Self::Multiview,
        Self::ConservativeRasterization,
        Self::BufferDeviceAddress,
        Self::AccelerationStructure,
        Self::RayQuery,
        Self::Int64,
        Self::SubgroupOperations,
        Self::TimestampQueries,
    ];

    /// Returns Vulkan's name of the feature, for messages and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::ScalarBlockLayout => "scalarBlockLayout",
            Self::Synchronization2 => "synchronization2",
            Self::DynamicRendering => "dynamicRendering",
            Self::FragmentStoresAndAtomics => "fragmentStoresAndAtomics",
            Self::Multiview => "multiview",
            Self::ConservativeRasterization => "VK_EXT_conservative_rasterization",
            Self::BufferDeviceAddress => "bufferDeviceAddress",
            Self::AccelerationStructure => "accelerationStructure",
            Self::RayQuery => "rayQuery",
            Self::Int64 => "shaderInt64",
            Self::SubgroupOperations => "subgroup operations",
            Self::TimestampQueries => "timestamp queries",
        }
    }

    /// Returns the extensions that bring this feature to a device of the given API version; empty if the
    /// feature is core in that version.
    pub(crate) fn extensions(self, api_version: u32) -> &'static [&'static CStr] {
        match self {
            Self::Synchronization2 if api_version < vk::API_VERSION_1_3 => {
                &[ash::khr::synchronization2::NAME]
            }
            Self::DynamicRendering if api_version < vk::API_VERSION_1_3 => {
                &[ash::khr::dynamic_rendering::NAME]
            }
            Self::ConservativeRasterization => &[ash::ext::conservative_rasterization::NAME],
            // Each extension is listed with those that it depends on.
            Self::AccelerationStructure => {
                &[ash::khr::acceleration_structure::NAME, ash::khr::deferred_host_operations::NAME]
            }
            Self::RayQuery => &[
                ash::khr::ray_query::NAME,
                ash::khr::acceleration_structure::NAME,
                ash::khr::deferred_host_operations::NAME,
            ],
            _ => &[],
        }
    }

    /// Returns true if the feature needs a graphics queue.
    pub(crate) fn needs_graphics(self) -> bool {
        matches!(
            self,
            Self::DynamicRendering
                | Self::FragmentStoresAndAtomics
                | Self::Multiview
                | Self::ConservativeRasterization
        )
    }

    /// Returns the Vulkan switch of the feature; `None` if Vulkan has no switch for it.
    pub(crate) fn switch(self, structs: &mut FeatureStructs) -> Option<&mut vk::Bool32> {
        match self {
            Self::ScalarBlockLayout => Some(&mut structs.v12.scalar_block_layout),
            Self::Synchronization2 => Some(&mut structs.synchronization2.synchronization2),
            Self::DynamicRendering => Some(&mut structs.dynamic_rendering.dynamic_rendering),
            Self::FragmentStoresAndAtomics => Some(&mut structs.core.fragment_stores_and_atomics),
            Self::Multiview => Some(&mut structs.v11.multiview),
            Self::BufferDeviceAddress => Some(&mut structs.v12.buffer_device_address),
            Self::AccelerationStructure => Some(&mut structs.acceleration_structure.acceleration_structure),
            Self::RayQuery => Some(&mut structs.ray_query.ray_query),
            Self::Int64 => Some(&mut structs.core.shader_int64),
            Self::ConservativeRasterization | Self::SubgroupOperations | Self::TimestampQueries => None,
        }
    }
}

impl fmt::Display for Feature {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

/// Vulkan structures that contain the switches.
#[derive(Default)]
pub(crate) struct FeatureStructs {
    core: vk::PhysicalDeviceFeatures,
    v11: vk::PhysicalDeviceVulkan11Features<'static>,
    v12: vk::PhysicalDeviceVulkan12Features<'static>,
    synchronization2: vk::PhysicalDeviceSynchronization2Features<'static>,
    dynamic_rendering: vk::PhysicalDeviceDynamicRenderingFeatures<'static>,
    acceleration_structure: vk::PhysicalDeviceAccelerationStructureFeaturesKHR<'static>,
    ray_query: vk::PhysicalDeviceRayQueryFeaturesKHR<'static>,
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
        let knows = |feature: Feature| {
            feature.extensions(api_version).iter().all(|extension| has_extension(extension))
        };
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
        if knows(Feature::AccelerationStructure) {
            chain = chain.push_next(&mut self.acceleration_structure);
        }
        if knows(Feature::RayQuery) {
            chain = chain.push_next(&mut self.ray_query);
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

//! Limits of a device that this project depends on.

use ash::vk;

use crate::memory::device_local_bytes;

/// Limits of a device. Sizes are in bytes.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Limits {
    /// Maximum range of one storage buffer binding.
    pub max_storage_buffer_range: u64,
    /// Alignment of the offset of a storage buffer binding.
    pub min_storage_buffer_offset_alignment: u64,
    /// Maximum number of storage buffers that one shader stage can access, over all sets.
    pub max_storage_buffers_per_stage: u32,
    /// Maximum number of descriptor sets bound at once.
    pub max_bound_sets: u32,
    /// Maximum size of the push constants of a pipeline.
    pub max_push_constants: u32,
    /// Maximum number of workgroups of one dispatch along each axis.
    pub max_workgroup_count: [u32; 3],
    /// Maximum number of invocations of one workgroup along each axis.
    pub max_workgroup_size: [u32; 3],
    /// Maximum number of invocations of one workgroup.
    pub max_workgroup_invocations: u32,
    /// Maximum size of the shared memory of one workgroup.
    pub max_shared_memory: u32,
    /// Maximum width and height of a raster view, in pixels.
    pub max_framebuffer_size: [u32; 2],
    /// Maximum number of layers of a raster view.
    pub max_framebuffer_layers: u32,
    /// Maximum number of views of a multiview draw.
    pub max_multiview_views: u32,
    /// Maximum size of a single allocation.
    pub max_memory_allocation: u64,
    /// Size of the largest device-local heap.
    pub device_local_bytes: u64,
    /// Duration of one tick of a timestamp, in nanoseconds.
    pub timestamp_period: f32,
    /// Number of valid bits of a timestamp on the queue in use; 0 if the queue has no timestamps.
    pub timestamp_valid_bits: u32,
    /// Number of invocations of a subgroup.
    pub subgroup_size: u32,
}

impl Limits {
    /// Reads the limits of a device.
    ///
    /// # Safety
    /// `physical` belongs to `instance` and supports Vulkan 1.2.
    pub(crate) unsafe fn read(
        instance: &ash::Instance,
        physical: vk::PhysicalDevice,
        timestamp_valid_bits: u32,
    ) -> Self {
        let mut v11 = vk::PhysicalDeviceVulkan11Properties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut v11);
        // SAFETY: the caller guarantees device and instance; the structure is core in 1.2.
        unsafe { instance.get_physical_device_properties2(physical, &mut properties) };
        // SAFETY: as above.
        let memory = unsafe { instance.get_physical_device_memory_properties(physical) };
        let device_local_bytes = device_local_bytes(&memory);
        let limits = properties.properties.limits;
        Self {
            max_storage_buffer_range: limits.max_storage_buffer_range.into(),
            min_storage_buffer_offset_alignment: limits.min_storage_buffer_offset_alignment.max(1),
            max_storage_buffers_per_stage: limits.max_per_stage_descriptor_storage_buffers,
            max_bound_sets: limits.max_bound_descriptor_sets,
            max_push_constants: limits.max_push_constants_size,
            max_workgroup_count: limits.max_compute_work_group_count,
            max_workgroup_size: limits.max_compute_work_group_size,
            max_workgroup_invocations: limits.max_compute_work_group_invocations,
            max_shared_memory: limits.max_compute_shared_memory_size,
            max_framebuffer_size: [
                limits.max_framebuffer_width.min(limits.max_viewport_dimensions[0]),
                limits.max_framebuffer_height.min(limits.max_viewport_dimensions[1]),
            ],
            max_framebuffer_layers: limits.max_framebuffer_layers,
            max_multiview_views: v11.max_multiview_view_count,
            max_memory_allocation: v11.max_memory_allocation_size,
            device_local_bytes,
            timestamp_period: limits.timestamp_period,
            timestamp_valid_bits,
            subgroup_size: v11.subgroup_size,
        }
    }
}

//! Acceleration structures that the driver builds over boxes, for ray queries of shaders
//! (`VK_KHR_acceleration_structure`).

use std::sync::Arc;

use ash::vk;

use crate::buffer::{Buffer, BufferDesc, BufferUsage};
use crate::device::Device;
use crate::device_core::Core;
use crate::error::{During, GpuError, Result};
use crate::features::Feature;
use crate::memory::MemoryLocation;

/// Bytes of a box in the driver's format: two corners.
pub const DRIVER_BOX_BYTES: u64 = size_of::<vk::AabbPositionsKHR>() as u64;

/// Property of a tree that the driver favours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DriverTreeGoal {
    /// Fast traces.
    Trace,
    /// Fast builds.
    Build,
}

/// Description of a tree to be made.
#[derive(Debug, Clone, Copy)]
pub struct DriverTreeDesc<'a> {
    /// Name for errors and tools.
    pub name: &'a str,
    /// Maximum number of boxes that the tree is built over.
    pub boxes: u32,
    /// Property that the driver favours.
    pub goal: DriverTreeGoal,
}

/// A tree of the driver over boxes, a top level with one instance of it, and the memory of both. Clones are
/// handles to the same tree.
#[derive(Clone)]
pub struct DriverTree {
    inner: Arc<TreeInner>,
}

struct TreeInner {
    name: String,
    boxes: u32,
    goal: DriverTreeGoal,
    bottom: Level,
    top: Level,
    /// Instance record that the host wrote.
    instance: Buffer,
    /// Scratch memory, which both levels use, one after the other.
    scratch: Buffer,
    /// First address within the scratch memory that a build may use.
    scratch_address: u64,
}

/// A `VkAccelerationStructureKHR` with its buffer.
struct Level {
    core: Arc<Core>,
    raw: vk::AccelerationStructureKHR,
    buffer: Buffer,
    address: u64,
}

impl std::fmt::Debug for DriverTree {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("DriverTree")
            .field("name", &self.inner.name)
            .field("boxes", &self.inner.boxes)
            .finish_non_exhaustive()
    }
}

impl Device {
    /// Makes a tree. It is empty until a build is recorded ([`crate::Recorder::build_driver_tree`]).
    ///
    /// # Errors
    /// [`GpuError::FeatureNotEnabled`] without [`Feature::AccelerationStructure`] and
    /// [`Feature::BufferDeviceAddress`]; [`GpuError::LimitExceeded`] for more boxes than the device supports;
    /// out of memory, or an error that the driver reports.
    pub fn create_driver_tree(&self, desc: &DriverTreeDesc<'_>) -> Result<DriverTree> {
        let core = &self.core;
        for feature in [Feature::AccelerationStructure, Feature::BufferDeviceAddress] {
            core.require(feature, desc.name)?;
        }
        let limits = tree_limits(core);
        if u64::from(desc.boxes) > limits.max_primitive_count {
            return Err(GpuError::LimitExceeded {
                name: desc.name.to_owned(),
                what: "the number of boxes of a tree of the driver",
                asked: desc.boxes.into(),
                limit: limits.max_primitive_count,
            });
        }
        let bottom_sizes = sizes(core, &Input::Boxes { address: 0, count: desc.boxes }, desc.goal)?;
        let top_sizes = sizes(core, &Input::Instance { address: 0 }, desc.goal)?;
        let bottom = self.level(desc.name, vk::AccelerationStructureTypeKHR::BOTTOM_LEVEL, &bottom_sizes)?;
        let top = self.level(desc.name, vk::AccelerationStructureTypeKHR::TOP_LEVEL, &top_sizes)?;
        let instance = self.create_buffer(&BufferDesc {
            name: &format!("{} instance", desc.name),
            size: size_of::<vk::AccelerationStructureInstanceKHR>() as u64,
            usage: BufferUsage::STORAGE,
            location: MemoryLocation::Upload,
        })?;
        instance.write(0, &instance_bytes(bottom.address))?;
        let alignment = u64::from(limits.min_acceleration_structure_scratch_offset_alignment.max(1));
        let scratch_size = bottom_sizes.build_scratch_size.max(top_sizes.build_scratch_size);
        let scratch = self.create_buffer(&BufferDesc {
            name: &format!("{} scratch", desc.name),
            size: scratch_size + alignment - 1,
            usage: BufferUsage::STORAGE,
            location: MemoryLocation::Device,
        })?;
        let scratch_address = address_of(&scratch)?.next_multiple_of(alignment);
        let inner = TreeInner {
            name: desc.name.to_owned(),
            boxes: desc.boxes,
            goal: desc.goal,
            bottom,
            top,
            instance,
            scratch,
            scratch_address,
        };
        Ok(DriverTree { inner: Arc::new(inner) })
    }

    /// Makes one level with its own memory.
    fn level(
        &self,
        name: &str,
        kind: vk::AccelerationStructureTypeKHR,
        sizes: &vk::AccelerationStructureBuildSizesInfoKHR<'_>,
    ) -> Result<Level> {
        let core = &self.core;
        let trees = trees(core)?;
        let buffer = self.create_buffer(&BufferDesc {
            name,
            size: sizes.acceleration_structure_size,
            usage: BufferUsage::TREE,
            location: MemoryLocation::Device,
        })?;
        let info = vk::AccelerationStructureCreateInfoKHR::default()
            .buffer(buffer.raw())
            .size(sizes.acceleration_structure_size)
            .ty(kind);
        // SAFETY: the buffer was made for this purpose, with the size that the driver requested.
        let raw = unsafe { trees.create_acceleration_structure(&info, None) }
            .during("vkCreateAccelerationStructureKHR", name)?;
        core.name_object(raw, name);
        let info = vk::AccelerationStructureDeviceAddressInfoKHR::default().acceleration_structure(raw);
        // SAFETY: the tree was just made from this device.
        let address = unsafe { trees.get_acceleration_structure_device_address(&info) };
        Ok(Level { core: core.clone(), raw, buffer, address })
    }
}

impl DriverTree {
    /// Returns the address from which shaders make an `accelerationStructureEXT`.
    pub fn address(&self) -> u64 {
        self.inner.top.address
    }

    /// Returns the maximum number of boxes that the tree is built over.
    pub fn boxes(&self) -> u32 {
        self.inner.boxes
    }

    /// Returns the bytes of both levels and the instance.
    pub fn bytes(&self) -> u64 {
        let TreeInner { bottom, top, instance, .. } = &*self.inner;
        bottom.buffer.size() + top.buffer.size() + instance.size()
    }

    /// Returns the bytes that only builds use.
    pub fn scratch_bytes(&self) -> u64 {
        self.inner.scratch.size()
    }

    /// Returns an error unless the tree is of this device.
    pub(crate) fn check_device(&self, core: &Arc<Core>) -> Result<()> {
        self.inner.scratch.check_use(core, BufferUsage::default(), "builds")
    }

    /// Returns the handles that must live until the device has finished with the tree.
    pub(crate) fn kept(&self) -> Arc<dyn std::any::Any + Send + Sync> {
        self.inner.clone()
    }

    /// Records both builds over `count` boxes at an address, with a barrier between them.
    ///
    /// # Safety
    /// The command buffer is being recorded, outside of rendering. The boxes at `address` (a multiple of 8)
    /// are at most as many as the tree was made for, and lie in memory that was made for builds. That memory
    /// and this tree live until the device has finished.
    pub(crate) unsafe fn record(
        &self,
        command: vk::CommandBuffer,
        address: u64,
        count: u32,
        barrier: impl FnOnce(),
    ) -> Result<()> {
        let TreeInner { goal, bottom, top, instance, scratch_address, .. } = &*self.inner;
        let trees = trees(&bottom.core)?;
        let build = |input: &Input, level: &Level| {
            let geometries = [input.geometry()];
            let info = input
                .info(&geometries, *goal)
                .dst_acceleration_structure(level.raw)
                .scratch_data(vk::DeviceOrHostAddressKHR { device_address: *scratch_address });
            let range =
                [vk::AccelerationStructureBuildRangeInfoKHR::default().primitive_count(input.count())];
            // SAFETY: the caller guarantees the command buffer and the boxes; levels and scratch memory have
            // the sizes that the driver requested, and the scratch address is aligned.
            unsafe { trees.cmd_build_acceleration_structures(command, &[info], &[&range]) };
        };
        build(&Input::Boxes { address, count }, bottom);
        barrier();
        build(&Input::Instance { address: address_of(instance)? }, top);
        Ok(())
    }
}

impl Drop for Level {
    fn drop(&mut self) {
        if let (true, Some(trees)) = (self.core.is_usable(), &self.core.trees) {
            // SAFETY: the tree was made from this device; submissions that use it hold handles, so none is
            // left.
            unsafe { trees.destroy_acceleration_structure(self.raw, None) };
        }
    }
}

/// Input of the build of a level.
enum Input {
    Boxes { address: u64, count: u32 },
    Instance { address: u64 },
}

impl Input {
    fn count(&self) -> u32 {
        match self {
            Self::Boxes { count, .. } => *count,
            Self::Instance { .. } => 1,
        }
    }

    fn geometry(&self) -> vk::AccelerationStructureGeometryKHR<'static> {
        let at = |address: u64| vk::DeviceOrHostAddressConstKHR { device_address: address };
        let (kind, data) = match self {
            Self::Boxes { address, .. } => (
                vk::GeometryTypeKHR::AABBS,
                vk::AccelerationStructureGeometryDataKHR {
                    aabbs: vk::AccelerationStructureGeometryAabbsDataKHR::default()
                        .data(at(*address))
                        .stride(DRIVER_BOX_BYTES),
                },
            ),
            Self::Instance { address } => (
                vk::GeometryTypeKHR::INSTANCES,
                vk::AccelerationStructureGeometryDataKHR {
                    instances: vk::AccelerationStructureGeometryInstancesDataKHR::default()
                        .data(at(*address)),
                },
            ),
        };
        vk::AccelerationStructureGeometryKHR::default().geometry_type(kind).geometry(data)
    }

    fn info<'a>(
        &self,
        geometries: &'a [vk::AccelerationStructureGeometryKHR<'a>],
        goal: DriverTreeGoal,
    ) -> vk::AccelerationStructureBuildGeometryInfoKHR<'a> {
        let kind = match self {
            Self::Boxes { .. } => vk::AccelerationStructureTypeKHR::BOTTOM_LEVEL,
            Self::Instance { .. } => vk::AccelerationStructureTypeKHR::TOP_LEVEL,
        };
        let flags = match goal {
            DriverTreeGoal::Trace => vk::BuildAccelerationStructureFlagsKHR::PREFER_FAST_TRACE,
            DriverTreeGoal::Build => vk::BuildAccelerationStructureFlagsKHR::PREFER_FAST_BUILD,
        };
        vk::AccelerationStructureBuildGeometryInfoKHR::default()
            .ty(kind)
            .flags(flags)
            .mode(vk::BuildAccelerationStructureModeKHR::BUILD)
            .geometries(geometries)
    }
}

/// Returns the functions of `VK_KHR_acceleration_structure`.
fn trees(core: &Core) -> Result<&ash::khr::acceleration_structure::Device> {
    core.trees.as_ref().ok_or_else(|| GpuError::FeatureNotEnabled {
        feature: Feature::AccelerationStructure,
        what: "a tree of the driver".to_owned(),
    })
}

fn address_of(buffer: &Buffer) -> Result<u64> {
    buffer.address().ok_or_else(|| GpuError::FeatureNotEnabled {
        feature: Feature::BufferDeviceAddress,
        what: buffer.name().to_owned(),
    })
}

/// Returns the sizes of the memory that a level and its build need.
fn sizes(
    core: &Core,
    input: &Input,
    goal: DriverTreeGoal,
) -> Result<vk::AccelerationStructureBuildSizesInfoKHR<'static>> {
    let geometries = [input.geometry()];
    let info = input.info(&geometries, goal);
    let mut sizes = vk::AccelerationStructureBuildSizesInfoKHR::default();
    // SAFETY: the build has one geometry, and one count is given; addresses are not read.
    unsafe {
        trees(core)?.get_acceleration_structure_build_sizes(
            vk::AccelerationStructureBuildTypeKHR::DEVICE,
            &info,
            &[input.count()],
            &mut sizes,
        );
    }
    Ok(sizes)
}

fn tree_limits(core: &Core) -> vk::PhysicalDeviceAccelerationStructurePropertiesKHR<'static> {
    let mut limits = vk::PhysicalDeviceAccelerationStructurePropertiesKHR::default();
    let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut limits);
    // SAFETY: the device belongs to the instance, and the extension of the structure is enabled.
    unsafe { core.instance.get_physical_device_properties2(core.physical, &mut properties) };
    limits
}

/// Returns the bytes of an identity instance of a level in the layout of
/// `VkAccelerationStructureInstanceKHR`: rows of a matrix, a number and a mask, two words of flags, an
/// address.
fn instance_bytes(address: u64) -> [u8; 64] {
    const IDENTITY: [f32; 12] = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    const SEEN_BY_ALL: u32 = 0xFF << 24;
    let mut bytes = [0; 64];
    bytes[..48].copy_from_slice(bytemuck::bytes_of(&IDENTITY));
    bytes[48..52].copy_from_slice(&SEEN_BY_ALL.to_ne_bytes());
    bytes[56..].copy_from_slice(&address.to_ne_bytes());
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_instance_is_as_vulkan_has_it() {
        let matrix = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let instance = vk::AccelerationStructureInstanceKHR {
            transform: vk::TransformMatrixKHR { matrix },
            instance_custom_index_and_mask: vk::Packed24_8::new(0, 0xFF),
            instance_shader_binding_table_record_offset_and_flags: vk::Packed24_8::new(0, 0),
            acceleration_structure_reference: vk::AccelerationStructureReferenceKHR {
                device_handle: 0x0123_4567_89AB_CDEF,
            },
        };
        assert_eq!(size_of_val(&instance), 64);
        // SAFETY: both types have 64 bytes; the lengths of the members add up to that, so there is no
        // padding.
        let expected =
            unsafe { std::mem::transmute::<vk::AccelerationStructureInstanceKHR, [u8; 64]>(instance) };
        assert_eq!(instance_bytes(0x0123_4567_89AB_CDEF), expected);
        assert_eq!(DRIVER_BOX_BYTES, 24);
    }
}

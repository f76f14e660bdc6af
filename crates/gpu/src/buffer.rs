//! Buffers: descriptions, handles, and access by the host.

use std::ops::{BitOr, BitOrAssign};
use std::ptr::NonNull;
use std::sync::{Arc, Mutex, PoisonError};

use ash::vk;

use crate::device::Device;
use crate::device_core::Core;
use crate::error::{During, GpuError, Result};
use crate::features::Feature;
use crate::memory::{Allocation, MemoryLocation};

/// Uses of a buffer. Values combine with `|`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct BufferUsage(u32);

impl BufferUsage {
    /// Read and written by shaders; also by address if [`Feature::BufferDeviceAddress`] is enabled, and read
    /// by builds of the driver's trees if [`Feature::AccelerationStructure`] is enabled.
    pub const STORAGE: BufferUsage = BufferUsage(1);
    /// Arguments of indirect dispatches and draws.
    pub const INDIRECT: BufferUsage = BufferUsage(1 << 1);
    /// Source of copies and downloads.
    pub const TRANSFER_SRC: BufferUsage = BufferUsage(1 << 2);
    /// Target of copies, fills and uploads.
    pub const TRANSFER_DST: BufferUsage = BufferUsage(1 << 3);
    /// All public uses.
    pub const ALL: BufferUsage = BufferUsage((1 << 4) - 1);
    /// Memory of a driver tree.
    pub(crate) const TREE: BufferUsage = BufferUsage(1 << 4);

    /// Returns true if this set contains every use of `other`.
    pub const fn contains(self, other: BufferUsage) -> bool {
        self.0 & other.0 == other.0
    }

    fn flags(self, addresses: bool, trees: bool) -> vk::BufferUsageFlags {
        let mut flags = vk::BufferUsageFlags::empty();
        let table = [
            (Self::TREE, vk::BufferUsageFlags::ACCELERATION_STRUCTURE_STORAGE_KHR),
            (Self::STORAGE, vk::BufferUsageFlags::STORAGE_BUFFER),
            (Self::INDIRECT, vk::BufferUsageFlags::INDIRECT_BUFFER),
            (Self::TRANSFER_SRC, vk::BufferUsageFlags::TRANSFER_SRC),
            (Self::TRANSFER_DST, vk::BufferUsageFlags::TRANSFER_DST),
        ];
        for (usage, flag) in table {
            if self.contains(usage) {
                flags |= flag;
            }
        }
        if addresses && (self.contains(Self::STORAGE) || self.contains(Self::TREE)) {
            flags |= vk::BufferUsageFlags::SHADER_DEVICE_ADDRESS;
        }
        if trees && addresses && self.contains(Self::STORAGE) {
            flags |= vk::BufferUsageFlags::ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_KHR;
        }
        flags
    }
}

impl BitOr for BufferUsage {
    type Output = BufferUsage;

    fn bitor(self, other: BufferUsage) -> BufferUsage {
        BufferUsage(self.0 | other.0)
    }
}

impl BitOrAssign for BufferUsage {
    fn bitor_assign(&mut self, other: BufferUsage) {
        self.0 |= other.0;
    }
}

/// Description of a buffer to be made.
#[derive(Debug, Clone, Copy)]
pub struct BufferDesc<'a> {
    /// Name for errors and tools.
    pub name: &'a str,
    /// Size in bytes; 0 becomes 16, so that empty input needs no special case.
    pub size: u64,
    /// Uses; must not be empty.
    pub usage: BufferUsage,
    /// Memory accesses by host and device that the buffer is made for.
    pub location: MemoryLocation,
}

/// A buffer that a host made, see [`Device::buffer_from_raw`].
#[derive(Debug, Clone, Copy)]
pub struct RawBuffer<'a> {
    /// Name for errors and tools.
    pub name: &'a str,
    /// Vulkan buffer.
    pub raw: vk::Buffer,
    /// Size of the buffer in bytes.
    pub size: u64,
    /// Uses that the buffer was made for.
    pub usage: BufferUsage,
}

/// Memory of a device, made by [`Device::create_buffer`] or wrapped by [`Device::buffer_from_raw`]. Clones
/// are handles to the same buffer.
#[derive(Clone)]
pub struct Buffer {
    pub(crate) inner: Arc<BufferInner>,
}

pub(crate) struct BufferInner {
    pub(crate) core: Arc<Core>,
    raw: vk::Buffer,
    name: String,
    size: u64,
    usage: BufferUsage,
    address: Option<u64>,
    /// Host address of the memory; the lock separates host accesses by different threads.
    mapped: Option<Mutex<Mapped>>,
    /// Memory of the buffer; `None` for a buffer that a host made.
    owned: Option<OwnedMemory>,
}

/// Host address of the first byte of a buffer.
struct Mapped(NonNull<u8>);

// SAFETY: the memory behind the address belongs to this buffer only and may be accessed from any thread, by
// one thread at a time, which the lock around this value ensures.
unsafe impl Send for Mapped {}

struct OwnedMemory {
    allocation: Option<Allocation>,
    bytes: u64,
}

impl std::fmt::Debug for Buffer {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Buffer").field("name", &self.name()).field("size", &self.size()).finish()
    }
}

impl Device {
    /// Makes a buffer. Its contents are undefined.
    ///
    /// # Errors
    /// [`GpuError::OutOfDeviceMemory`] with the name of the buffer, [`GpuError::InvalidUse`] if no usage is
    /// given, or an error that the driver reports. [`Device::create_binding_set`] detects a buffer that is
    /// too large for a storage binding.
    pub fn create_buffer(&self, desc: &BufferDesc<'_>) -> Result<Buffer> {
        let core = &self.core;
        let size = if desc.size == 0 { 16 } else { desc.size };
        let usage = desc
            .usage
            .flags(self.has(Feature::BufferDeviceAddress), self.has(Feature::AccelerationStructure));
        if usage.is_empty() {
            return Err(GpuError::InvalidUse {
                name: desc.name.to_owned(),
                reason: "a buffer needs at least one usage".to_owned(),
            });
        }
        if size > core.limits.max_memory_allocation {
            return Err(GpuError::OutOfDeviceMemory {
                name: desc.name.to_owned(),
                asked: size,
                limit: core.limits.max_memory_allocation,
                allocated: self.allocated_bytes(),
                refused_by: "maxMemoryAllocationSize",
            });
        }
        let info =
            vk::BufferCreateInfo::default().size(size).usage(usage).sharing_mode(vk::SharingMode::EXCLUSIVE);
        // SAFETY: size and usage are not empty, and the address usage is set only if its feature is enabled.
        let raw = unsafe { core.device.create_buffer(&info, None) }.during("vkCreateBuffer", desc.name)?;
        core.name_object(raw, desc.name);
        // From here on, dropping `inner` destroys the buffer and frees its memory.
        let mut inner = BufferInner {
            core: core.clone(),
            raw,
            name: desc.name.to_owned(),
            size,
            usage: desc.usage,
            address: None,
            mapped: None,
            owned: Some(OwnedMemory { allocation: None, bytes: 0 }),
        };
        // SAFETY: the buffer was just made from this device.
        let requirements = unsafe { core.device.get_buffer_memory_requirements(raw) };
        let allocation = core.allocate(requirements, desc.location, desc.name)?;
        let (memory, offset, mapped) = (allocation.memory, allocation.offset, allocation.mapped);
        inner.owned = Some(OwnedMemory { allocation: Some(allocation), bytes: requirements.size });
        // SAFETY: the piece fulfils the requirements of the buffer (contract of `Memory`), which is unbound.
        unsafe { core.device.bind_buffer_memory(raw, memory, offset) }
            .during("vkBindBufferMemory", desc.name)?;
        if desc.location != MemoryLocation::Device {
            let pointer = mapped.ok_or_else(|| GpuError::InvalidUse {
                name: desc.name.to_owned(),
                reason: "the memory source did not map memory for the host".to_owned(),
            })?;
            inner.mapped = Some(Mutex::new(Mapped(pointer)));
        }
        inner.address = self.address_of(raw, desc.usage);
        Ok(Buffer { inner: Arc::new(inner) })
    }

    /// Wraps a buffer that a host made, so that it can be bound and recorded. This crate does not destroy the
    /// buffer, does not access it from the host, and does not count it as allocated.
    ///
    /// # Safety
    /// The buffer was made from this device with exactly this size and at least this usage (with
    /// `VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT` if [`Feature::BufferDeviceAddress`] is enabled and the
    /// usage contains [`BufferUsage::STORAGE`]), is bound to memory, and outlives every handle of the
    /// returned value and all work recorded with it.
    pub unsafe fn buffer_from_raw(&self, raw: &RawBuffer<'_>) -> Buffer {
        let inner = BufferInner {
            core: self.core.clone(),
            raw: raw.raw,
            name: raw.name.to_owned(),
            size: raw.size,
            usage: raw.usage,
            address: self.address_of(raw.raw, raw.usage),
            mapped: None,
            owned: None,
        };
        Buffer { inner: Arc::new(inner) }
    }

    fn address_of(&self, raw: vk::Buffer, usage: BufferUsage) -> Option<u64> {
        if !self.has(Feature::BufferDeviceAddress) || !usage.contains(BufferUsage::STORAGE) {
            return None;
        }
        let info = vk::BufferDeviceAddressInfo::default().buffer(raw);
        // SAFETY: the feature is enabled, and the buffer has the address usage and memory.
        Some(unsafe { self.core.device.get_buffer_device_address(&info) })
    }
}

impl Buffer {
    /// Returns the name for errors and tools.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// Returns the size in bytes.
    pub fn size(&self) -> u64 {
        self.inner.size
    }

    /// Returns the uses that the buffer was made for.
    pub fn usage(&self) -> BufferUsage {
        self.inner.usage
    }

    /// Returns the Vulkan buffer.
    pub fn raw(&self) -> vk::Buffer {
        self.inner.raw
    }

    /// Returns the device address of the first byte; absent unless [`Feature::BufferDeviceAddress`] is
    /// enabled and the usage contains [`BufferUsage::STORAGE`].
    pub fn address(&self) -> Option<u64> {
        self.inner.address
    }

    /// Returns the address of the first byte for builds of the driver's trees; absent for a buffer that a
    /// host made, because its usage may not include builds.
    pub(crate) fn input_address(&self) -> Option<u64> {
        self.inner.owned.as_ref().and(self.inner.address)
    }

    /// Returns true if the host can read and write the buffer.
    pub fn is_host_visible(&self) -> bool {
        self.inner.mapped.is_some()
    }

    /// Writes bytes from the host. The device must not be using the range: see [ranges of
    /// buffers](crate#ranges-of-buffers) for the rule, and for the effects of a race.
    ///
    /// # Errors
    /// [`GpuError::InvalidUse`] for a device-local buffer, [`GpuError::OutOfRange`] for bytes beyond the end
    /// of the buffer.
    pub fn write(&self, offset: u64, bytes: &[u8]) -> Result<()> {
        self.check_range(offset, bytes.len() as u64)?;
        let mapped = self.mapped()?.lock().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: the mapping spans the buffer, the range lies in it, the lock excludes other threads, and
        // `bytes` cannot overlap memory that only this buffer knows.
        unsafe {
            let target = mapped.0.as_ptr().add(offset as usize);
            std::ptr::copy_nonoverlapping(bytes.as_ptr(), target, bytes.len());
        }
        Ok(())
    }

    /// Reads bytes to the host. The device must not be writing the range, and must have made its writes
    /// visible to the host, as every submission of [`Device::submit`] does at its end: see [ranges of
    /// buffers](crate#ranges-of-buffers).
    ///
    /// # Errors
    /// As [`Buffer::write`].
    pub fn read_into(&self, offset: u64, bytes: &mut [u8]) -> Result<()> {
        self.check_range(offset, bytes.len() as u64)?;
        let mapped = self.mapped()?.lock().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: as in `write`, with source and target exchanged.
        unsafe {
            let source = mapped.0.as_ptr().add(offset as usize);
            std::ptr::copy_nonoverlapping(source, bytes.as_mut_ptr(), bytes.len());
        }
        Ok(())
    }

    /// Reads `size` bytes to the host, see [`Buffer::read_into`].
    ///
    /// # Errors
    /// As [`Buffer::write`].
    pub fn read(&self, offset: u64, size: u64) -> Result<Vec<u8>> {
        self.check_range(offset, size)?;
        let mut bytes = vec![0; size as usize];
        self.read_into(offset, &mut bytes)?;
        Ok(bytes)
    }

    /// Returns an error unless the range lies within the buffer.
    pub(crate) fn check_range(&self, offset: u64, size: u64) -> Result<()> {
        if offset.checked_add(size).is_some_and(|end| end <= self.size()) {
            return Ok(());
        }
        Err(GpuError::OutOfRange { name: self.name().to_owned(), offset, size, buffer_size: self.size() })
    }

    /// Returns an error unless the buffer is of this device and was made for this usage; an empty usage asks
    /// for the device alone.
    pub(crate) fn check_use(&self, core: &Arc<Core>, usage: BufferUsage, what: &str) -> Result<()> {
        let reason = if !Arc::ptr_eq(&self.inner.core, core) {
            "belongs to another device".to_owned()
        } else if !self.usage().contains(usage) {
            format!("was not created for {what}")
        } else {
            return Ok(());
        };
        Err(GpuError::InvalidUse { name: self.name().to_owned(), reason })
    }

    fn mapped(&self) -> Result<&Mutex<Mapped>> {
        self.inner.mapped.as_ref().ok_or_else(|| GpuError::InvalidUse {
            name: self.name().to_owned(),
            reason: "is device-local: use upload and download".to_owned(),
        })
    }
}

impl Drop for BufferInner {
    fn drop(&mut self) {
        let Some(owned) = self.owned.take() else { return };
        if !self.core.is_usable() {
            std::mem::forget(owned);
            return;
        }
        // SAFETY: the buffer was made from this device; binding sets and submissions that use it hold
        // handles, so none is left, and embedders keep the objects that they record alive.
        unsafe { self.core.device.destroy_buffer(self.raw, None) };
        if let Some(allocation) = owned.allocation {
            // SAFETY: the only buffer bound to this piece was just destroyed.
            unsafe { self.core.free(allocation, owned.bytes) };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_asked_for_only_where_enabled_and_useful() {
        let address = vk::BufferUsageFlags::SHADER_DEVICE_ADDRESS;
        assert!(!BufferUsage::STORAGE.flags(false, false).contains(address));
        assert!(BufferUsage::STORAGE.flags(true, false).contains(address));
        assert!(!BufferUsage::TRANSFER_SRC.flags(true, true).contains(address));
        assert!(BufferUsage::TREE.flags(true, true).contains(address), "trees have addresses as well");
        let input = vk::BufferUsageFlags::ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_KHR;
        let with_input = [(true, true), (true, false), (false, true)]
            .map(|(addresses, trees)| BufferUsage::STORAGE.flags(addresses, trees).contains(input));
        assert_eq!(with_input, [true, false, false]);
        assert!((BufferUsage::STORAGE | BufferUsage::INDIRECT).contains(BufferUsage::INDIRECT));
    }
}

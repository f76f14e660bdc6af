//! Memory of buffers: its source, and the accounting of the bytes in use.

use std::any::Any;
use std::ptr::NonNull;
use std::sync::{Mutex, MutexGuard, PoisonError};

use ash::vk;
use gpu_allocator::vulkan as pooled;

use crate::error::{GpuError, Result};

/// Location of a buffer's memory, by the parties that read and write it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MemoryLocation {
    /// Read and written by the device only.
    Device,
    /// Written by the host, read by the device.
    Upload,
    /// Written by the device, read by the host.
    Readback,
}

/// A piece of device memory.
pub struct Allocation {
    /// Vulkan memory object that contains the piece.
    pub memory: vk::DeviceMemory,
    /// Start of the piece within the memory object, in bytes.
    pub offset: u64,
    /// Host address of the piece, if it is host-visible.
    pub mapped: Option<NonNull<u8>>,
    /// Data that the allocator needs to free the piece.
    pub token: Option<Box<dyn Any + Send + Sync>>,
}

// SAFETY: the address is only a number here; code that reads or writes through it synchronises the accesses
// (`Buffer` does so with a lock).
unsafe impl Send for Allocation {}
// SAFETY: a shared reference gives access to plain values only, see above.
unsafe impl Sync for Allocation {}

/// A source of device memory; a host may supply its own.
///
/// # Safety
/// A piece returned by [`Memory::allocate`] must fulfil the requirements, belong to no other buffer, stay
/// valid and in place until it is freed, and be host-visible, host-coherent and mapped for
/// [`MemoryLocation::Upload`] and [`MemoryLocation::Readback`]. If
/// [`Feature::BufferDeviceAddress`](crate::Feature::BufferDeviceAddress) is enabled, it must come from an
/// allocation with `VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT`.
pub unsafe trait Memory: Send + Sync {
    /// Allocates a piece for a buffer.
    ///
    /// # Errors
    /// [`GpuError::OutOfDeviceMemory`] if no memory is left.
    fn allocate(
        &self,
        requirements: vk::MemoryRequirements,
        location: MemoryLocation,
        name: &str,
    ) -> Result<Allocation>;

    /// Frees a piece.
    ///
    /// # Safety
    /// The piece came from [`Memory::allocate`] of this value, and nothing uses it any more.
    unsafe fn free(&self, allocation: Allocation);

    /// Returns the bytes given out and not taken back, by the count of this source; `None` if it does not
    /// count.
    fn bytes_given_out(&self) -> Option<u64> {
        None
    }
}

/// Default source of memory: blocks of 16 MiB on the device and 4 MiB on the host, which small buffers share.
pub struct PooledMemory {
    allocator: Mutex<pooled::Allocator>,
    device_local_bytes: u64,
}

impl PooledMemory {
    const DEVICE_BLOCK_BYTES: u64 = 16 << 20;
    const HOST_BLOCK_BYTES: u64 = 4 << 20;

    /// Makes a pool on a device; `addresses` is true if buffers will be reached by device address. The pool
    /// must be dropped before the device is destroyed.
    ///
    /// # Errors
    /// [`GpuError::Memory`] with the report of the allocator.
    pub fn new(
        instance: &ash::Instance,
        physical: vk::PhysicalDevice,
        device: &ash::Device,
        addresses: bool,
    ) -> Result<Self> {
        let desc = pooled::AllocatorCreateDesc {
            instance: instance.clone(),
            device: device.clone(),
            physical_device: physical,
            debug_settings: gpu_allocator::AllocatorDebugSettings::default(),
            buffer_device_address: addresses,
            allocation_sizes: gpu_allocator::AllocationSizes::new(
                Self::DEVICE_BLOCK_BYTES,
                Self::HOST_BLOCK_BYTES,
            ),
        };
        let allocator =
            pooled::Allocator::new(&desc).map_err(|error| from_allocator(&error, "memory pool"))?;
        // SAFETY: the physical device belongs to the instance.
        let properties = unsafe { instance.get_physical_device_memory_properties(physical) };
        let device_local_bytes = device_local_bytes(&properties);
        Ok(Self { allocator: Mutex::new(allocator), device_local_bytes })
    }

    fn lock(&self) -> MutexGuard<'_, pooled::Allocator> {
        self.allocator.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

// SAFETY: gpu-allocator gives out disjoint pieces that fulfil the requirements, maps host-visible blocks once
// for their lifetime, uses only coherent types for the two host locations, and sets the address flag on its
// blocks if `new` told it so.
unsafe impl Memory for PooledMemory {
    fn allocate(
        &self,
        requirements: vk::MemoryRequirements,
        location: MemoryLocation,
        name: &str,
    ) -> Result<Allocation> {
        let desc = pooled::AllocationCreateDesc {
            name,
            requirements,
            location: match location {
                MemoryLocation::Device => gpu_allocator::MemoryLocation::GpuOnly,
                MemoryLocation::Upload => gpu_allocator::MemoryLocation::CpuToGpu,
                MemoryLocation::Readback => gpu_allocator::MemoryLocation::GpuToCpu,
            },
            linear: true,
            allocation_scheme: pooled::AllocationScheme::GpuAllocatorManaged,
        };
        let piece = self.lock().allocate(&desc).map_err(|error| match error {
            gpu_allocator::AllocationError::OutOfMemory => GpuError::OutOfDeviceMemory {
                name: name.to_owned(),
                asked: requirements.size,
                limit: self.device_local_bytes,
                allocated: 0,
                refused_by: ALLOCATE,
            },
            other => from_allocator(&other, name),
        })?;
        // SAFETY: the handle is used only to bind a buffer to it, and is freed with the piece.
        let memory = unsafe { piece.memory() };
        let mapped = match location {
            MemoryLocation::Device => None,
            MemoryLocation::Upload | MemoryLocation::Readback => piece.mapped_ptr().map(NonNull::cast),
        };
        Ok(Allocation { memory, offset: piece.offset(), mapped, token: Some(Box::new(piece)) })
    }

    unsafe fn free(&self, allocation: Allocation) {
        let Some(Ok(piece)) = allocation.token.map(|token| token.downcast::<pooled::Allocation>()) else {
            tracing::error!("memory was given back to a pool that it does not come from; it is leaked");
            return;
        };
        if let Err(error) = self.lock().free(*piece) {
            tracing::error!("memory could not be given back: {error}");
        }
    }

    fn bytes_given_out(&self) -> Option<u64> {
        Some(self.lock().generate_report().total_allocated_bytes)
    }
}

const ALLOCATE: &str = "vkAllocateMemory";

/// Converts an error of the allocator to one of this crate. The allocator passes on result codes as words
/// only.
fn from_allocator(error: &gpu_allocator::AllocationError, name: &str) -> GpuError {
    use gpu_allocator::AllocationError as Refusal;
    let (call, text) = match error {
        Refusal::FailedToMap(text) => ("vkMapMemory", text.as_str()),
        Refusal::Internal(text) if text.contains(ALLOCATE) => (ALLOCATE, text.as_str()),
        other => return GpuError::Memory { name: name.to_owned(), reason: other.to_string() },
    };
    let codes = [
        vk::Result::ERROR_OUT_OF_HOST_MEMORY,
        vk::Result::ERROR_OUT_OF_DEVICE_MEMORY,
        vk::Result::ERROR_TOO_MANY_OBJECTS,
        vk::Result::ERROR_MEMORY_MAP_FAILED,
        vk::Result::ERROR_DEVICE_LOST,
    ];
    let says = |code: &vk::Result| text.ends_with(&format!("{code:?}")) || text == code.to_string();
    match codes.into_iter().find(says) {
        Some(code) => GpuError::from_vulkan(code, call, name),
        None => GpuError::Memory { name: name.to_owned(), reason: format!("{call} failed: {text}") },
    }
}

/// Returns the bytes of the largest device-local heap; 0 if there is none.
pub(crate) fn device_local_bytes(properties: &vk::PhysicalDeviceMemoryProperties) -> u64 {
    let heaps = properties.memory_heaps_as_slice().iter();
    let local = heaps.filter(|heap| heap.flags.contains(vk::MemoryHeapFlags::DEVICE_LOCAL));
    local.map(|heap| heap.size).max().unwrap_or(0)
}

/// Accounting of the memory in use, with its limit.
pub(crate) struct Ledger {
    totals: Mutex<Totals>,
}

struct Totals {
    allocated: u64,
    peak: u64,
    limit: Option<u64>,
}

impl Ledger {
    pub(crate) fn new(limit: Option<u64>) -> Self {
        Self { totals: Mutex::new(Totals { allocated: 0, peak: 0, limit }) }
    }

    fn lock(&self) -> MutexGuard<'_, Totals> {
        self.totals.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds `bytes` to the memory in use, unless that would exceed the limit.
    pub(crate) fn reserve(&self, name: &str, bytes: u64) -> Result<()> {
        let mut totals = self.lock();
        let after = totals.allocated.saturating_add(bytes);
        if let Some(limit) = totals.limit.filter(|limit| after > *limit) {
            return Err(GpuError::OutOfDeviceMemory {
                name: name.to_owned(),
                asked: bytes,
                limit,
                allocated: totals.allocated,
                refused_by: "the memory limit of this device",
            });
        }
        totals.allocated = after;
        totals.peak = totals.peak.max(after);
        Ok(())
    }

    pub(crate) fn release(&self, bytes: u64) {
        let mut totals = self.lock();
        totals.allocated = totals.allocated.saturating_sub(bytes);
    }

    pub(crate) fn allocated(&self) -> u64 {
        self.lock().allocated
    }

    pub(crate) fn peak(&self) -> u64 {
        self.lock().peak
    }

    pub(crate) fn reset_peak(&self) {
        let mut totals = self.lock();
        totals.peak = totals.allocated;
    }

    pub(crate) fn set_limit(&self, limit: Option<u64>) {
        self.lock().limit = limit;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn result_codes_are_found_in_the_words_of_the_allocator() {
        use gpu_allocator::AllocationError as Refusal;
        let lost = Refusal::Internal("Unexpected error in vkAllocateMemory: ERROR_DEVICE_LOST".to_owned());
        assert!(matches!(
            from_allocator(&lost, "nodes"),
            GpuError::DeviceLost { call: "vkAllocateMemory", during } if during == "nodes"
        ));
        let host = Refusal::FailedToMap(vk::Result::ERROR_OUT_OF_HOST_MEMORY.to_string());
        assert!(matches!(from_allocator(&host, "a"), GpuError::OutOfHostMemory { call: "vkMapMemory", .. }));
        let unknown = from_allocator(&Refusal::FailedToMap("moon".to_owned()), "nodes").to_string();
        assert!(unknown.contains("vkMapMemory") && unknown.contains("moon"), "{unknown}");
        let other = from_allocator(&Refusal::NoCompatibleMemoryTypeFound, "nodes");
        assert!(matches!(other, GpuError::Memory { name, .. } if name == "nodes"));
    }

    #[test]
    fn heaps_of_the_host_are_no_memory_of_the_device() {
        let mut properties = vk::PhysicalDeviceMemoryProperties::default();
        assert_eq!(device_local_bytes(&properties), 0);
        let heaps = [
            (64 << 30, vk::MemoryHeapFlags::empty()),
            (8 << 30, vk::MemoryHeapFlags::DEVICE_LOCAL),
            (256 << 20, vk::MemoryHeapFlags::DEVICE_LOCAL),
        ];
        properties.memory_heap_count = heaps.len() as u32;
        for (heap, (size, flags)) in properties.memory_heaps.iter_mut().zip(heaps) {
            *heap = vk::MemoryHeap { size, flags };
        }
        assert_eq!(device_local_bytes(&properties), 8 << 30);
    }

    #[test]
    fn the_ledger_keeps_total_peak_and_limit() {
        let ledger = Ledger::new(Some(100));
        assert!(ledger.reserve("first", 60).is_ok());
        let error = ledger.reserve("second", 41).expect_err("the limit is 100");
        assert!(
            matches!(&error, GpuError::OutOfDeviceMemory { name, asked: 41, limit: 100, allocated: 60, .. } if name == "second"),
            "{error:?}"
        );
        assert!(ledger.reserve("third", 40).is_ok());
        ledger.release(60);
        assert_eq!((ledger.allocated(), ledger.peak()), (40, 100));
        ledger.reset_peak();
        assert_eq!(ledger.peak(), 40);
        ledger.set_limit(None);
        assert!(ledger.reserve("fourth", 1000).is_ok());
    }
}

//! Transfers between host and buffers, for applications and tests: each call waits.

use bytemuck::{NoUninit, Pod};

use crate::buffer::{Buffer, BufferDesc, BufferUsage};
use crate::device::Device;
use crate::error::{GpuError, Result};
use crate::memory::MemoryLocation;

/// Maximum size of a staging buffer in bytes: small enough for devices with little host-visible memory.
const STAGING_BYTES: u64 = 16 << 20;

impl Device {
    /// Writes bytes into a buffer; if it is not host-visible, through staging buffers of at most 16 MiB.
    ///
    /// # Errors
    /// [`GpuError::OutOfRange`] for bytes beyond the buffer's end, [`GpuError::InvalidUse`] if a device-local
    /// buffer was not made for [`BufferUsage::TRANSFER_DST`], or as [`Device::submit`].
    pub fn upload(&self, buffer: &Buffer, offset: u64, bytes: &[u8]) -> Result<()> {
        buffer.check_range(offset, bytes.len() as u64)?;
        if bytes.is_empty() {
            return Ok(());
        }
        if buffer.is_host_visible() {
            return buffer.write(offset, bytes);
        }
        let staging = self.create_buffer(&BufferDesc {
            name: "upload staging",
            size: STAGING_BYTES.min(bytes.len() as u64),
            usage: BufferUsage::TRANSFER_SRC,
            location: MemoryLocation::Upload,
        })?;
        let mut at = offset;
        for chunk in bytes.chunks(STAGING_BYTES as usize) {
            staging.write(0, chunk)?;
            let size = chunk.len() as u64;
            self.submit(|recorder| recorder.copy(&staging, 0, buffer, at, size))?;
            at += size;
        }
        Ok(())
    }

    /// Reads bytes from a buffer; if it is not host-visible, through staging buffers of at most 16 MiB.
    ///
    /// # Errors
    /// [`GpuError::OutOfRange`] for bytes beyond the buffer's end, [`GpuError::InvalidUse`] if a device-local
    /// buffer was not made for [`BufferUsage::TRANSFER_SRC`], or as [`Device::submit`].
    pub fn download(&self, buffer: &Buffer, offset: u64, size: u64) -> Result<Vec<u8>> {
        let length = host_length(buffer, offset, size)?;
        let mut bytes = vec![0; length];
        self.download_into(buffer, offset, &mut bytes)?;
        Ok(bytes)
    }

    /// Reads bytes as [`Device::download`] does, into memory of the caller.
    ///
    /// # Errors
    /// As [`Device::download`].
    pub fn download_into(&self, buffer: &Buffer, offset: u64, bytes: &mut [u8]) -> Result<()> {
        buffer.check_range(offset, bytes.len() as u64)?;
        if bytes.is_empty() {
            return Ok(());
        }
        if buffer.is_host_visible() {
            return buffer.read_into(offset, bytes);
        }
        let staging = self.create_buffer(&BufferDesc {
            name: "download staging",
            size: STAGING_BYTES.min(bytes.len() as u64),
            usage: BufferUsage::TRANSFER_DST,
            location: MemoryLocation::Readback,
        })?;
        let mut at = offset;
        for chunk in bytes.chunks_mut(STAGING_BYTES as usize) {
            let size = chunk.len() as u64;
            self.submit(|recorder| recorder.copy(buffer, at, &staging, 0, size))?;
            staging.read_into(0, chunk)?;
            at += size;
        }
        Ok(())
    }

    /// Writes values into a buffer; `offset` is in bytes.
    ///
    /// # Errors
    /// As [`Device::upload`].
    pub fn upload_slice<T: NoUninit>(&self, buffer: &Buffer, offset: u64, values: &[T]) -> Result<()> {
        self.upload(buffer, offset, bytemuck::cast_slice(values))
    }

    /// Reads `count` values from a buffer; `offset` is in bytes.
    ///
    /// # Errors
    /// As [`Device::download`].
    pub fn download_as<T: Pod>(&self, buffer: &Buffer, offset: u64, count: usize) -> Result<Vec<T>> {
        host_length(buffer, offset, (count as u64).saturating_mul(size_of::<T>() as u64))?;
        let mut values = vec![T::zeroed(); count];
        self.download_into(buffer, offset, bytemuck::cast_slice_mut(&mut values))?;
        Ok(values)
    }

    /// Makes a device-local buffer that contains `values`, for shaders and copies. Without values the buffer
    /// has 16 undefined bytes.
    ///
    /// # Errors
    /// As [`Device::create_buffer`] and [`Device::upload`].
    pub fn create_buffer_with<T: NoUninit>(
        &self,
        name: &str,
        usage: BufferUsage,
        values: &[T],
    ) -> Result<Buffer> {
        let bytes: &[u8] = bytemuck::cast_slice(values);
        let buffer = self.create_buffer(&BufferDesc {
            name,
            size: bytes.len() as u64,
            usage: usage | BufferUsage::TRANSFER_DST,
            location: MemoryLocation::Device,
        })?;
        self.upload(&buffer, 0, bytes)?;
        Ok(buffer)
    }

    /// Makes a buffer that contains zeros before any command is recorded, for data that shaders read first.
    /// The host writes the zeros without a submission, so the buffer is host-visible; it is on the device if
    /// the device has such memory. It is meant for small buffers.
    ///
    /// # Errors
    /// As [`Device::create_buffer`].
    pub fn create_buffer_of_zeros(&self, name: &str, usage: BufferUsage, size: u64) -> Result<Buffer> {
        let usage = usage | BufferUsage::TRANSFER_DST;
        let buffer =
            self.create_buffer(&BufferDesc { name, size, usage, location: MemoryLocation::Upload })?;
        buffer.write(0, &vec![0; size as usize])?;
        Ok(buffer)
    }

    /// Makes a device-local buffer. If this device has a queue, the function clears the buffer through it,
    /// which submits and waits; otherwise the contents are undefined until commands write them. It is meant
    /// for large buffers that are read only where data was written.
    ///
    /// # Errors
    /// As [`Device::create_buffer`] and [`Device::submit`].
    pub fn create_cleared_buffer(&self, name: &str, usage: BufferUsage, size: u64) -> Result<Buffer> {
        let usage = usage | BufferUsage::TRANSFER_DST;
        let buffer =
            self.create_buffer(&BufferDesc { name, size, usage, location: MemoryLocation::Device })?;
        if self.has_queue() {
            self.submit(|recorder| recorder.fill(&buffer, 0, buffer.size(), 0))?;
        }
        Ok(buffer)
    }
}

/// Checks the range before host memory of its size is allocated, and returns its length.
fn host_length(buffer: &Buffer, offset: u64, size: u64) -> Result<usize> {
    buffer.check_range(offset, size)?;
    usize::try_from(size)
        .map_err(|_| GpuError::OutOfHostMemory { call: "download", during: buffer.name().to_owned() })
}

//! Upload of tables to the device.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use bytemuck::{NoUninit, cast_slice};
use rasray_gpu::{Access, Buffer, BufferDesc, BufferUsage, Device, MemoryLocation, Recorder, Result};

/// Copy from host memory to the buffer that shaders read.
#[derive(Debug)]
struct StagedCopy {
    from: Buffer,
    to: Buffer,
}

/// Way of filling tables: at once, with a wait, or by a recording of the caller. Clones are handles to the
/// same tables.
#[derive(Clone, Debug, Default)]
pub(crate) struct Staging(Arc<Mutex<Option<Vec<StagedCopy>>>>);

impl Staging {
    /// Makes tables that a recording fills.
    pub fn later() -> Self {
        Self(Arc::new(Mutex::new(Some(Vec::new()))))
    }

    fn copies(&self) -> MutexGuard<'_, Option<Vec<StagedCopy>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Makes a buffer on the device that holds `values`, or will hold them once the recording has run.
    ///
    /// # Errors
    /// Errors of [`Device::create_buffer_with`].
    pub fn buffer<T: NoUninit>(
        &self,
        device: &Device,
        name: &str,
        usage: BufferUsage,
        values: &[T],
    ) -> Result<Buffer> {
        let mut copies = self.copies();
        let Some(copies) = &mut *copies else { return device.create_buffer_with(name, usage, values) };
        let bytes: &[u8] = cast_slice(values);
        let size = bytes.len() as u64;
        let usage = usage | BufferUsage::TRANSFER_DST;
        let to = device.create_buffer(&BufferDesc { name, size, usage, location: MemoryLocation::Device })?;
        if size > 0 {
            let (usage, location) = (BufferUsage::TRANSFER_SRC, MemoryLocation::Upload);
            let from = device.create_buffer(&BufferDesc { name: "staged table", size, usage, location })?;
            from.write(0, bytes)?;
            copies.push(StagedCopy { from, to: to.clone() });
        }
        Ok(to)
    }

    /// Records the copies, visible to all later commands; records nothing if none is left.
    pub fn record(&self, recorder: &mut Recorder<'_>) {
        let copies = self.copies();
        let Some(copies) = copies.as_ref().filter(|copies| !copies.is_empty()) else { return };
        copies.iter().for_each(|StagedCopy { from, to }| recorder.copy(from, 0, to, 0, from.size()));
        recorder.barrier(Access::TRANSFER_WRITE, Access::ALL);
    }

    /// Notes that the recording was submitted: buffers made from then on are filled at once.
    pub fn end(&self) {
        *self.copies() = None;
    }
}

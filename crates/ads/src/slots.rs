//! Outcomes of builds, which the host reads, kept separately per slot.

use bytemuck::{AnyBitPattern, pod_read_unaligned};
use rasray_gpu::{Buffer, BufferDesc, BufferUsage, Device, GpuError, MemoryLocation};

use crate::AdsError;

/// Returns an error unless a build can be recorded for `slot`.
pub(crate) fn check_recorded(structure: &'static str, slot: u32, slots: u32) -> Result<(), AdsError> {
    if slot < slots { Ok(()) } else { Err(AdsError::Slot { structure, slot, slots }) }
}

/// Returns an error unless `slot` has an outcome to read.
pub(crate) fn check_read(structure: &str, slot: u32, slots: u32) -> Result<(), GpuError> {
    if slot < slots {
        return Ok(());
    }
    let reason = format!("slot {slot} of {slots} was requested");
    Err(GpuError::InvalidUse { name: structure.to_owned(), reason })
}

/// Outcome of a build per slot, and the pools for which each build was recorded.
#[derive(Debug)]
pub(crate) struct Slots {
    structure: &'static str,
    header_bytes: u64,
    /// Per slot, the header after its build followed by the count of triangles outside; one more entry for
    /// builds without a slot.
    entries: Buffer,
    /// Number of builds whose outcomes are kept separately: the maximum number of frames that the device
    /// works on at a time.
    count: u32,
    /// Slot of the build that is being recorded; equal to `count` if the build has none.
    recorded: u32,
    /// Number of times that the pools were replaced.
    replaced: u32,
    /// Value of `replaced` when the last build of each slot was recorded.
    replaced_before: Vec<u32>,
}

impl Slots {
    /// Makes one slot with zeros.
    pub fn new(device: &Device, structure: &'static str, header_bytes: u64) -> Result<Self, AdsError> {
        Ok(Self {
            structure,
            header_bytes,
            entries: entries(device, structure, header_bytes, 1)?,
            count: 1,
            recorded: 1,
            replaced: 0,
            replaced_before: vec![0],
        })
    }

    /// Sets the number of slots, at least 1, and fills all slots with zeros. After an error nothing has
    /// changed.
    pub fn set_count(&mut self, device: &Device, count: u32) -> Result<(), AdsError> {
        let count = count.max(1);
        self.entries = entries(device, self.structure, self.header_bytes, count)?;
        (self.count, self.recorded) = (count, count);
        self.replaced_before = vec![self.replaced; count as usize];
        Ok(())
    }

    /// Begins the recording of a build of `slot`, for the present pools.
    pub fn begin(&mut self, slot: u32) -> Result<(), AdsError> {
        check_recorded(self.structure, slot, self.count)?;
        self.recorded = slot;
        self.replaced_before[slot as usize] = self.replaced;
        Ok(())
    }

    /// Begins the recording of a build whose outcome the host does not read.
    pub fn begin_unread(&mut self) {
        self.recorded = self.count;
    }

    /// Notes that the pools were replaced. Entries are kept: the device may have yet to write those of builds
    /// recorded before.
    pub fn replace_pools(&mut self) {
        self.replaced += 1;
        self.begin_unread();
    }

    /// Returns true if the pools are those for which the last build of a slot was recorded.
    pub fn are_pools_of(&self, slot: u32) -> bool {
        self.replaced_before.get(slot as usize) == Some(&self.replaced)
    }

    /// Returns buffer and byte to which a recording copies the header.
    pub fn header_target(&self) -> (&Buffer, u64) {
        (&self.entries, self.place(self.recorded))
    }

    /// Returns buffer and byte to which a recording copies the count of triangles outside.
    pub fn outside_target(&self) -> (&Buffer, u64) {
        (&self.entries, self.place(self.recorded) + self.header_bytes)
    }

    /// Returns the header after the last build of a slot.
    pub fn header<H: AnyBitPattern>(&self, slot: u32) -> Result<H, GpuError> {
        check_read(self.structure, slot, self.count)?;
        Ok(pod_read_unaligned(&self.entries.read(self.place(slot), size_of::<H>() as u64)?))
    }

    /// Returns the number of triangles that the last build of a slot found outside of the bounds.
    pub fn outside(&self, slot: u32) -> Result<u32, GpuError> {
        check_read(self.structure, slot, self.count)?;
        Ok(pod_read_unaligned(&self.entries.read(self.place(slot) + self.header_bytes, 4)?))
    }

    fn place(&self, slot: u32) -> u64 {
        u64::from(slot) * entry_bytes(self.header_bytes)
    }
}

/// Returns the bytes of an entry: the header, and the count of triangles outside.
fn entry_bytes(header_bytes: u64) -> u64 {
    header_bytes + 4
}

/// Makes a buffer of zeros for the entries of `slots` slots, and one more.
fn entries(device: &Device, structure: &str, header_bytes: u64, slots: u32) -> Result<Buffer, AdsError> {
    let size = entry_bytes(header_bytes) * (u64::from(slots) + 1);
    let buffer = device.create_buffer(&BufferDesc {
        name: &format!("{structure} header readback"),
        size,
        usage: BufferUsage::TRANSFER_DST,
        location: MemoryLocation::Readback,
    })?;
    buffer.write(0, &vec![0; size as usize])?;
    Ok(buffer)
}

//! Outcomes of builds that the host reads, kept apart per slot.

use bytemuck::{AnyBitPattern, pod_read_unaligned};
use rasray_gpu::{Buffer, BufferDesc, BufferUsage, Device, GpuError, MemoryLocation};

use crate::AdsError;

/// An error unless a build can be recorded for `slot`.
pub(crate) fn check_recorded(structure: &'static str, slot: u32, slots: u32) -> Result<(), AdsError> {
    if slot < slots { Ok(()) } else { Err(AdsError::Slot { structure, slot, slots }) }
}

/// An error unless there is a build of `slot` to read.
pub(crate) fn check_read(structure: &str, slot: u32, slots: u32) -> Result<(), GpuError> {
    if slot < slots {
        return Ok(());
    }
    let reason = format!("slot {slot} of {slots} was requested");
    Err(GpuError::InvalidUse { name: structure.to_owned(), reason })
}

/// An entry per slot, and which pools its build was recorded for.
#[derive(Debug)]
pub(crate) struct Slots {
    structure: &'static str,
    header_bytes: u64,
    /// Per slot the header after its build, and behind it the count of triangles outside; one more entry for
    /// builds without a slot.
    entries: Buffer,
    /// Builds whose outcome is kept apart: frames that the device works on at a time.
    count: u32,
    /// The slot of the build that is recorded; the count where it has none.
    recorded: u32,
    /// Times that the pools were replaced.
    replaced: u32,
    /// That number when the last build of each slot was recorded.
    replaced_before: Vec<u32>,
}

impl Slots {
    /// One slot, of zeros.
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

    /// That many slots from now on, at least 1, of zeros. After an error all is as it was.
    pub fn set_count(&mut self, device: &Device, count: u32) -> Result<(), AdsError> {
        let count = count.max(1);
        self.entries = entries(device, self.structure, self.header_bytes, count)?;
        (self.count, self.recorded) = (count, count);
        self.replaced_before = vec![self.replaced; count as usize];
        Ok(())
    }

    /// Begins the recording of a build of `slot`, for the pools that there are.
    pub fn begin(&mut self, slot: u32) -> Result<(), AdsError> {
        check_recorded(self.structure, slot, self.count)?;
        self.recorded = slot;
        self.replaced_before[slot as usize] = self.replaced;
        Ok(())
    }

    /// Begins the recording of a build that nobody reads.
    pub fn begin_unread(&mut self) {
        self.recorded = self.count;
    }

    /// The pools are others. Entries stay: the device may have yet to write those of builds that were
    /// recorded before.
    pub fn replace_pools(&mut self) {
        self.replaced += 1;
        self.begin_unread();
    }

    /// True if the pools are those that the last build of a slot was recorded for.
    pub fn are_pools_of(&self, slot: u32) -> bool {
        self.replaced_before.get(slot as usize) == Some(&self.replaced)
    }

    /// Buffer that a recording copies the header to.
    pub fn header_target(&self) -> (&Buffer, u64) {
        (&self.entries, self.place(self.recorded))
    }

    /// Buffer that a recording copies the count of triangles outside to.
    pub fn outside_target(&self) -> (&Buffer, u64) {
        (&self.entries, self.place(self.recorded) + self.header_bytes)
    }

    /// The header after the last build of a slot.
    pub fn header<H: AnyBitPattern>(&self, slot: u32) -> Result<H, GpuError> {
        check_read(self.structure, slot, self.count)?;
        Ok(pod_read_unaligned(&self.entries.read(self.place(slot), size_of::<H>() as u64)?))
    }

    /// Triangles that the last build of a slot found outside.
    pub fn outside(&self, slot: u32) -> Result<u32, GpuError> {
        check_read(self.structure, slot, self.count)?;
        Ok(pod_read_unaligned(&self.entries.read(self.place(slot) + self.header_bytes, 4)?))
    }

    fn place(&self, slot: u32) -> u64 {
        u64::from(slot) * entry_bytes(self.header_bytes)
    }
}

/// Bytes of an entry: the header, and the count of triangles outside.
fn entry_bytes(header_bytes: u64) -> u64 {
    header_bytes + 4
}

/// Zeros for the entries of `slots` slots, and one more.
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

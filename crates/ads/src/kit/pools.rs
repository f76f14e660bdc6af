//! Buffers of one structure: a header that shaders start from, and pools.

use std::mem::offset_of;
use std::sync::atomic::{AtomicU32, Ordering};

use bytemuck::AnyBitPattern;
use rasray_gpu::{
    Access, BindingSet, Buffer, BufferDesc, BufferUsage, Device, GpuError, MemoryLocation, Recorder,
    SetLayout,
};

use crate::kit::addressing::halves;
use crate::kit::{HEADER_POOL, Lookup, PoolName, TraceKernels};
use crate::slots::Slots;
use crate::{
    Addressing, AdsError, Domain, Geometry, InlineTrace, PoolSize, QueueHeader, RayQueue, Sizes, Trace,
};

/// Byte in the header of a queue of the number of list entries with an invalid index that traces through a
/// structure met.
const NOTED: u64 = offset_of!(QueueHeader, corrupted) as u64;

/// Factor by which the number of rounds grows if rays did not finish.
const MORE_ROUNDS: u32 = 4;

/// Maximum number of rounds: 2^15 dispatches per trace, and that number times the work budget per ray, which
/// on software drivers is 2^26 units.
const MOST_ROUNDS: u32 = 1 << 14;

/// Buffers of one set of sizes, one per pool, in the order of [`Sizes::pools`]. The first is the header, of
/// one element. Its first word is the status, which traces read before any other data.
#[derive(Debug)]
pub struct Pools {
    structure: &'static str,
    addressing: Addressing,
    layout: SetLayout,
    sizes: Sizes,
    /// Header that the next build begins with.
    header: Vec<u8>,
    /// Outcomes of builds, which the host reads.
    slots: Slots,
    pools: Vec<Buffer>,
    set: Option<BindingSet>,
    /// Number of rounds allowed so far, if more than a trace has at first. Traces raise it, so it changes
    /// behind a shared reference.
    rounds: AtomicU32,
}

impl Pools {
    /// Allocates the buffers. The set has one binding per pool in the order of `sizes`, or no binding if
    /// shaders use addresses.
    ///
    /// # Errors
    /// Out of memory; a pool exceeds the maximum size of a binding (device addresses avoid that limit).
    pub fn new(
        device: &Device,
        structure: &'static str,
        addressing: Addressing,
        sizes: &Sizes,
    ) -> Result<Self, AdsError> {
        let bindings = match addressing {
            Addressing::Descriptor => sizes.pools.len() as u32,
            Addressing::Address => 0,
        };
        let layout = device.create_set_layout(structure, bindings)?;
        let header_bytes = bytes(sizes, HEADER_POOL);
        let (pools, set) = allocate(device, structure, addressing, &layout, sizes)?;
        Ok(Self {
            structure,
            addressing,
            layout,
            sizes: sizes.clone(),
            header: vec![0; header_bytes as usize],
            slots: Slots::new(device, structure, header_bytes)?,
            pools,
            set,
            rounds: AtomicU32::new(0),
        })
    }

    /// Allocates the buffers again. The build is lost; outcomes that the device has yet to write for builds
    /// recorded before are kept.
    ///
    /// # Errors
    /// As for [`Pools::new`]; the pools are then unchanged.
    pub fn resize(&mut self, device: &Device, sizes: &Sizes) -> Result<(), AdsError> {
        (self.pools, self.set) = allocate(device, self.structure, self.addressing, &self.layout, sizes)?;
        self.sizes = sizes.clone();
        self.header.fill(0);
        self.slots.replace_pools();
        *self.rounds.get_mut() = 0;
        Ok(())
    }

    /// Returns true if the pools are those for which the last build of a slot was recorded.
    pub fn are_of(&self, slot: u32) -> bool {
        self.slots.are_pools_of(slot)
    }

    /// Keeps the outcomes of `slots` builds separately from now on, at least 1; outcomes of earlier builds
    /// are lost.
    ///
    /// # Errors
    /// Out of memory; nothing changes then.
    pub fn set_slots(&mut self, device: &Device, slots: u32) -> Result<(), AdsError> {
        self.slots.set_count(device, slots)
    }

    /// Returns the layout of the set; empty if shaders use addresses.
    pub fn layout(&self) -> &SetLayout {
        &self.layout
    }

    /// Returns the set; absent if shaders use addresses.
    pub fn set(&self) -> Option<&BindingSet> {
        self.set.as_ref()
    }

    /// Returns the sizes of the allocated pools.
    pub fn sizes(&self) -> &Sizes {
        &self.sizes
    }

    /// Returns the buffer of a pool.
    ///
    /// # Panics
    /// The sizes were those of another structure.
    pub fn pool(&self, pool: impl PoolName) -> &Buffer {
        let index = self.sizes.pools.iter().position(|size| size.name == pool.name());
        &self.pools[index.unwrap_or_else(|| panic!("{} has no pool {pool:?}", self.structure))]
    }

    /// Returns the buffer of the header.
    pub fn header_buffer(&self) -> &Buffer {
        &self.pools[0]
    }

    /// Returns the device address of the header, which shaders start from; 0 with descriptors.
    pub fn address(&self) -> u64 {
        match self.addressing {
            Addressing::Descriptor => 0,
            Addressing::Address => self.pools[0].address().unwrap_or(0),
        }
    }

    /// Returns the device address of a pool as a header holds it, low word first; zero with descriptors.
    fn address_of(&self, pool: impl PoolName) -> [u32; 2] {
        let address = match self.addressing {
            Addressing::Descriptor => 0,
            Addressing::Address => self.pool(pool).address().unwrap_or(0),
        };
        halves(address)
    }

    /// Sets the header from which the passes recorded next start, except the addresses of `P`, and the slot
    /// that keeps their outcome. Each recording has its own header, so several builds that wait for the
    /// device do not share one.
    ///
    /// # Errors
    /// The slot does not exist.
    ///
    /// # Panics
    /// The pools are those of another structure.
    pub fn begin<P: PoolName>(&mut self, slot: u32, header: P::Header) -> Result<(), AdsError> {
        self.slots.begin(slot)?;
        self.keep_header::<P>(header);
        Ok(())
    }

    /// Sets the header as [`Pools::begin`] does, for a build whose outcome the host does not read.
    ///
    /// # Panics
    /// The pools are those of another structure.
    pub fn begin_unread<P: PoolName>(&mut self, header: P::Header) {
        self.slots.begin_unread();
        self.keep_header::<P>(header);
    }

    fn keep_header<P: PoolName>(&mut self, mut header: P::Header) {
        for pool in P::ALL {
            if let Some(address) = pool.address_in(&mut header) {
                *address = self.address_of(*pool);
            }
        }
        self.header.copy_from_slice(bytemuck::bytes_of(&header));
    }

    /// Records the upload of the header, zeros in the pools of `cleared` and the check of the triangles,
    /// visible to `readers`.
    pub(crate) fn record_header(
        &self,
        recorder: &mut Recorder<'_>,
        geometry: &Geometry,
        cleared: &[impl PoolName],
        readers: Access,
    ) {
        recorder.barrier(Access::ALL, Access::TRANSFER_WRITE);
        recorder.update(&self.pools[0], 0, &self.header);
        for pool in cleared {
            let pool = self.pool(*pool);
            recorder.fill(pool, 0, pool.size(), 0);
        }
        let (target, offset) = self.slots.outside_target();
        geometry.record_check(recorder, target, offset);
        recorder.barrier(Access::TRANSFER_WRITE | Access::COMPUTE_WRITE, readers | Access::HOST_READ);
        self.keep(recorder);
    }

    /// Records a status that says that nothing is built.
    pub(crate) fn record_forget(&self, recorder: &mut Recorder<'_>) {
        recorder.barrier(Access::COMPUTE | Access::TRANSFER, Access::TRANSFER_WRITE);
        recorder.fill(&self.pools[0], 0, size_of::<u32>() as u64, 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE | Access::TRANSFER);
    }

    /// Keeps buffers that shaders reach by address alive until the device has finished; a set keeps those
    /// that it binds.
    fn keep(&self, recorder: &mut Recorder<'_>) {
        if self.set.is_none() {
            for pool in &self.pools {
                recorder.keep_buffer(pool);
            }
        }
    }

    /// Returns the number of triangles that the last build of a slot found outside of their geometry's
    /// bounds, or with a vertex that does not exist. The caller has waited for the submission.
    ///
    /// # Errors
    /// The slot does not exist, or host-visible memory could not be read.
    pub fn outside(&self, slot: u32) -> Result<u32, GpuError> {
        self.slots.outside(slot)
    }

    /// Records the copy of the header to the host, after compute shaders wrote it.
    pub fn record_readback(&self, recorder: &mut Recorder<'_>) {
        recorder.barrier(Access::COMPUTE, Access::COMPUTE | Access::TRANSFER);
        let (target, offset) = self.slots.header_target();
        recorder.copy(&self.pools[0], 0, target, offset, self.pools[0].size());
        recorder.barrier(Access::TRANSFER, Access::COMPUTE | Access::TRANSFER | Access::HOST_READ);
    }

    /// Returns the header after the last build of a slot, zeros before the first build. The caller has waited
    /// for the submission.
    ///
    /// # Errors
    /// The slot does not exist, or host-visible memory could not be read.
    pub fn header<H: AnyBitPattern>(&self, slot: u32) -> Result<H, GpuError> {
        self.slots.header(slot)
    }

    /// Downloads a pool as words. Submits and waits: for tests and tools.
    ///
    /// # Errors
    /// The device failed.
    pub fn download_words(&self, device: &Device, pool: impl PoolName) -> Result<Vec<u32>, GpuError> {
        device.download_as::<u32>(self.pool(pool), 0, (bytes(&self.sizes, pool.name()) / 4) as usize)
    }

    /// Returns the bytes by part for a report: `used` returns the number of elements of a pool that are in
    /// use; all other elements are "slack".
    pub fn bytes_by_part(&self, used: impl Fn(&PoolSize) -> u64) -> Vec<(&'static str, u64)> {
        let mut slack = 0;
        let mut parts = Vec::with_capacity(self.sizes.pools.len() + 1);
        for pool in &self.sizes.pools {
            let used = used(pool).min(pool.elements);
            parts.push((pool.name, used * pool.element_bytes));
            slack += (pool.elements - used) * pool.element_bytes;
        }
        parts.push(("slack", slack));
        parts
    }

    /// Returns the interface through which an embedder's shader reaches the pools, with the structure's
    /// specialisation constants.
    pub fn inline_trace(&self, constants: Vec<(u32, u32)>) -> InlineTrace<'_> {
        InlineTrace { layout: &self.layout, set: self.set(), address: self.address(), constants }
    }

    /// Returns the number of rounds of a structure: `first`, until more are allowed.
    pub fn rounds(&self, first: u32) -> u32 {
        self.rounds.load(Ordering::Relaxed).max(first)
    }

    /// Multiplies the number that [`Pools::rounds`] returns for `first`, up to 2^14 rounds and up to `most`,
    /// in which every ray finishes. Returns false if the number does not change.
    pub fn allow_more_rounds(&self, first: u32, most: u32) -> bool {
        let now = self.rounds(first);
        let more = now.saturating_mul(MORE_ROUNDS).min(most).min(MOST_ROUNDS);
        self.rounds.fetch_max(more, Ordering::Relaxed);
        more > now
    }

    /// Returns `ample` rounds plus those in which a ray reads every stored element. A ray that needs more is
    /// in a list without an end, which only damaged memory has.
    pub fn rounds_to_read_all(&self, ample: u32, work_budget: u32) -> u32 {
        let elements: u64 = self.sizes.pools.iter().map(|pool| pool.elements).sum();
        let most = u64::from(ample) + elements.div_ceil(work_budget.into());
        most.min(u32::MAX.into()) as u32
    }

    /// Records a trace as [`TraceKernels::record_trace`] does. Traces count list entries with an invalid
    /// index in the word of the header at byte `corrupted`, and the queue copies that count
    /// ([`crate::QueueCounters::corrupted`]).
    #[expect(clippy::too_many_arguments, reason = "everything a trace depends on, each of its own type")]
    pub fn record_trace(
        &self,
        recorder: &mut Recorder<'_>,
        kernels: &TraceKernels,
        geometry: &Geometry,
        queue: &RayQueue,
        trace: Trace<'_>,
        rounds: u32,
        corrupted: usize,
    ) {
        self.keep(recorder);
        let (set, address) = (self.set(), self.address());
        kernels.record_trace(recorder, geometry, set, address, queue, trace, rounds);
        self.record_corrupted(recorder, queue, corrupted);
    }

    fn record_corrupted(&self, recorder: &mut Recorder<'_>, queue: &RayQueue, corrupted: usize) {
        recorder.barrier(Access::COMPUTE, Access::TRANSFER);
        recorder.copy(&self.pools[0], corrupted as u64, queue.header(), NOTED, 4);
        recorder.barrier(Access::TRANSFER, Access::COMPUTE | Access::TRANSFER | Access::INDIRECT_READ);
    }

    /// Records a lookup for the slots of `domain`, with faults counted as in [`Pools::record_trace`].
    pub fn record_lookup(
        &self,
        recorder: &mut Recorder<'_>,
        lookup: Lookup<'_>,
        geometry: &Geometry,
        queue: &RayQueue,
        domain: Domain,
        corrupted: usize,
    ) {
        self.keep(recorder);
        lookup.record(recorder, geometry, self.set(), self.address(), queue, domain);
        self.record_corrupted(recorder, queue, corrupted);
    }
}

/// Allocates the pools, and the set that binds them unless shaders use addresses.
fn allocate(
    device: &Device,
    structure: &'static str,
    addressing: Addressing,
    layout: &SetLayout,
    sizes: &Sizes,
) -> Result<(Vec<Buffer>, Option<BindingSet>), AdsError> {
    // Headers may hold the arguments of indirect dispatches.
    let usage =
        BufferUsage::STORAGE | BufferUsage::INDIRECT | BufferUsage::TRANSFER_SRC | BufferUsage::TRANSFER_DST;
    // Fresh memory may hold the header of a structure that was dropped. Zeros state that nothing is built.
    let name = |pool: &str| format!("{structure} {pool}");
    let mut pools =
        vec![device.create_buffer_of_zeros(&name(HEADER_POOL), usage, bytes(sizes, HEADER_POOL))?];
    for pool in sizes.pools.iter().skip(1) {
        pools.push(device.create_buffer(&BufferDesc {
            name: &name(pool.name),
            size: pool.elements * pool.element_bytes,
            usage,
            location: MemoryLocation::Device,
        })?);
    }
    let set = match addressing {
        Addressing::Descriptor => {
            let bindings: Vec<&Buffer> = pools.iter().collect();
            Some(device.create_binding_set(layout, structure, &bindings)?)
        }
        Addressing::Address => None,
    };
    Ok((pools, set))
}

fn bytes(sizes: &Sizes, name: &str) -> u64 {
    sizes.pool(name).map_or(0, PoolSize::bytes)
}

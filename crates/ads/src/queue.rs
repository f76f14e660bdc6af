//! Queues of rays on the device.

pub(crate) mod buffers;

use std::mem::offset_of;

use bytemuck::{Zeroable, bytes_of};
use rasray_gpu::{
    Access, BindingSet, Buffer, BufferDesc, BufferRange, BufferUsage, ComputePipeline, ComputePipelineDesc,
    Device, GpuError, MemoryLocation, Recorder, SetLayout,
};
use rasray_shaders_glsl::constants::contract::{DOMAIN_SELECTED, QUEUE_GROUP_SIZE};
use rasray_shaders_glsl::records::QueueTakeConstants;

use crate::queue::buffers::{BUFFERS, HEADER, STEPS};
use crate::{AdsError, Hit, QueueBuffers, QueueHeader, Ray, RayWork, Surface, TraceState, TraceStep};

/// Bytes before the first step: the logged slot and the number of steps, one u32 each.
const STEP_HEADER: u64 = 8;

/// Slots of a queue that a pass works on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// The first n slots.
    First(u32),
    /// The slots that shaders selected (`queue_select` of `ads/queue.glsl`) before the last
    /// [`RayQueue::record_take`], in no particular order. The device counts them, so the pass costs nothing
    /// for the other slots.
    Selected,
}

impl Domain {
    /// Returns the word for shaders: the number of first slots, or `DOMAIN_SELECTED`.
    pub fn word(self) -> u32 {
        match self {
            Self::First(count) => count,
            Self::Selected => DOMAIN_SELECTED,
        }
    }
}

/// Optional buffers of a queue, in addition to rays, hits and states. A buffer that is not requested is a
/// placeholder of 16 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct QueueParts {
    /// True for a [`Surface`] per slot.
    pub surfaces: bool,
    /// True for a [`RayWork`] per slot, written by structures that count per ray.
    pub work: bool,
    /// Capacity for [`TraceStep`]s of slot 0, written by structures that log steps.
    pub steps: u32,
}

/// Queue of rays on the device: rays, hits, surfaces and traversal states of `capacity` slots, and lists of
/// slots. A structure traces the rays of a queue and writes their hits. Clones are cheap handles to the same
/// buffers.
///
/// A queue that is made here is in the state after [`RayQueue::record_reset`], and no slot is selected. The
/// other buffers contain zeros, rays included, and zero rays miss. On a device without a queue to clear them,
/// the contents are undefined until something is written there.
#[derive(Clone, Debug)]
pub struct RayQueue {
    capacity: u32,
    take: ComputePipeline,
    header: Buffer,
    rays: Buffer,
    hits: Buffer,
    states: Buffer,
    list: Buffer,
    surfaces: Buffer,
    work: Buffer,
    steps: Buffer,
    step_capacity: u32,
    layout: SetLayout,
    set: BindingSet,
}

/// Sums over all traces since the last reset of the queue.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct QueueCounters {
    /// Number of rays given up after their last round.
    pub unfinished: u32,
    /// Number of rays traced while the structure was incomplete.
    pub not_ready: u32,
    /// Number of list entries with an invalid index in the structure last traced, summed over all its parts,
    /// since it was built; anything but 0 is a fault.
    pub corrupted: u32,
    /// Number of cells stepped; zero unless counters are enabled.
    pub cells: u64,
    /// Number of list entries read; zero unless counters are enabled.
    pub entries: u64,
    /// Number of primitives tested; zero unless counters are enabled.
    pub tests: u64,
    /// Number of views entered; a view counts again only after another view, and the near region does not
    /// count. Zero unless counters are enabled.
    pub views: u64,
    /// Number of cells stepped that were not rejected: cells in which a list entry was read, or occupied
    /// voxels. Zero unless counters are enabled.
    pub searched: u64,
}

impl RayQueue {
    /// Allocates a queue, with surfaces if requested. Submits and waits if the device has a queue, which
    /// clears the buffers.
    ///
    /// # Errors
    /// Out of memory, or a buffer exceeds what one binding can hold.
    pub fn new(device: &Device, name: &str, capacity: u32, surfaces: bool) -> Result<Self, AdsError> {
        Self::with_parts(device, name, capacity, QueueParts { surfaces, ..QueueParts::default() })
    }

    /// Allocates a queue with the requested parts. Submits and waits if the device has a queue, which clears
    /// the buffers.
    ///
    /// # Errors
    /// Out of memory, or a buffer exceeds what one binding can hold.
    pub fn with_parts(
        device: &Device,
        name: &str,
        capacity: u32,
        parts: QueueParts,
    ) -> Result<Self, AdsError> {
        let capacity = capacity.max(1);
        Self::made(device, name, capacity, parts, [const { None }; BUFFERS])
    }

    /// Makes a queue of `capacity` slots, at least 1, of buffers of the host: rays, hits, and any others
    /// given. Their contents stay.
    ///
    /// # Errors
    /// [`AdsError::Queue`] if a buffer is too small, lacks a usage, or is given twice; out of memory, or a
    /// buffer exceeds the maximum size of a binding.
    pub fn from_buffers(
        device: &Device,
        name: &str,
        capacity: u32,
        buffers: QueueBuffers,
    ) -> Result<Self, AdsError> {
        let capacity = capacity.max(1);
        let (parts, given) = buffers.checked(capacity)?;
        Self::made(device, name, capacity, parts, given)
    }

    fn made(
        device: &Device,
        name: &str,
        capacity: u32,
        parts: QueueParts,
        given: [Option<Buffer>; BUFFERS],
    ) -> Result<Self, AdsError> {
        let has_queue = device.has_queue();
        let is_given = given.each_ref().map(Option::is_some);
        let mut buffers = Vec::with_capacity(BUFFERS);
        for (place, ((part, size), given)) in sizes(capacity, parts).into_iter().zip(given).enumerate() {
            if let Some(buffer) = given {
                buffers.push(buffer);
                continue;
            }
            // The host writes the buffers that must have known contents at once, if commands cannot.
            let by_host = !has_queue && (place == HEADER || place == STEPS);
            buffers.push(device.create_buffer(&BufferDesc {
                name: &format!("{name} {part}"),
                size,
                usage: BufferUsage::ALL,
                location: if by_host { MemoryLocation::Upload } else { MemoryLocation::Device },
            })?);
        }
        let layout = Self::layout(device)?;
        let ranges: Vec<_> = buffers
            .iter()
            .zip(sizes(capacity, parts))
            .map(|(buffer, (_, size))| BufferRange {
                buffer,
                offset: 0,
                size: if size == 0 { buffer.size() } else { size },
            })
            .collect();
        let set = device.create_binding_set_of_ranges(&layout, name, &ranges)?;
        let shader = &rasray_shaders_glsl::ADS_QUEUE_TAKE;
        let take = device.create_compute_pipeline(&ComputePipelineDesc {
            name: shader.name,
            module: &shader.module(),
            sets: &[&layout],
            push_constant_bytes: size_of::<QueueTakeConstants>() as u32,
            constants: &[],
        })?;
        let Ok([header, rays, hits, states, list, surfaces, work, steps]) =
            <[Buffer; BUFFERS]>::try_from(buffers)
        else {
            unreachable!("there is a buffer for each binding")
        };
        let step_capacity = parts.steps;
        let queue = Self {
            capacity,
            take,
            header,
            rays,
            hits,
            states,
            list,
            surfaces,
            work,
            steps,
            step_capacity,
            layout,
            set,
        };
        if has_queue {
            device.submit(|recorder| {
                for (buffer, _) in queue.buffers().into_iter().zip(is_given).filter(|(_, is_given)| !is_given)
                {
                    recorder.fill(buffer, 0, buffer.size(), 0);
                }
                if !is_given[HEADER] {
                    queue.record_reset(recorder);
                }
            })?;
        } else {
            if !is_given[HEADER] {
                queue.header.write(0, bytes_of(&QueueHeader { capacity, ..QueueHeader::zeroed() }))?;
            }
            queue.steps.write(0, bytes_of(&queue.first_step_words()))?;
        }
        Ok(queue)
    }

    /// Returns the buffers in the order of bindings.
    fn buffers(&self) -> [&Buffer; BUFFERS] {
        let Self { header, rays, hits, states, list, surfaces, work, steps, .. } = self;
        [header, rays, hits, states, list, surfaces, work, steps]
    }

    /// Returns the words before the steps: slot 0 as the logged slot, or no slot if the capacity is 0, and
    /// the step count 0.
    fn first_step_words(&self) -> [u32; 2] {
        [if self.step_capacity > 0 { 0 } else { u32::MAX }, 0]
    }

    /// Returns the layout that all queues share.
    ///
    /// # Errors
    /// Out of memory.
    pub fn layout(device: &Device) -> Result<SetLayout, AdsError> {
        Ok(device.create_set_layout("ray queue", BUFFERS as u32)?)
    }

    /// Records the reset of counters and book-keeping: whenever counters shall start at 0, and once before
    /// first use if the header is a buffer of the host. No slot is selected afterwards.
    pub fn record_reset(&self, recorder: &mut Recorder<'_>) {
        let size = size_of::<QueueHeader>() as u64;
        recorder.barrier(Access::ALL, Access::TRANSFER_WRITE);
        recorder.fill(&self.header, 0, size, 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::TRANSFER_WRITE);
        recorder.fill(&self.header, offset_of!(QueueHeader, capacity) as u64, 4, self.capacity);
        for (word, value) in (0..).zip(self.first_step_words()) {
            recorder.fill(&self.steps, 4 * word, 4, value);
        }
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE | Access::TRANSFER);
    }

    /// Records that the slots selected so far become those of [`Domain::Selected`], and that a new selection
    /// begins. The shaders that selected them must precede it, with a barrier to compute shaders in between.
    pub fn record_take(&self, recorder: &mut Recorder<'_>) {
        self.record_taken(recorder, QueueTakeConstants { back: 0 });
    }

    /// Records that the slots of [`Domain::Selected`] are again those before the last take, after a pass that
    /// selected some of them for other uses. Permitted once per take, and before any slot is selected after
    /// the take; afterwards no slot is selected for the next take.
    pub fn record_take_back(&self, recorder: &mut Recorder<'_>) {
        self.record_taken(recorder, QueueTakeConstants { back: 1 });
    }

    fn record_taken(&self, recorder: &mut Recorder<'_>, constants: QueueTakeConstants) {
        recorder.bind_compute(&self.take);
        recorder.bind_sets(0, &[&self.set]);
        recorder.push_constants(bytes_of(&constants));
        recorder.dispatch([1, 1, 1]);
        recorder.barrier(Access::COMPUTE, Access::COMPUTE | Access::INDIRECT_READ | Access::TRANSFER);
    }

    /// Records that no slot is selected for the passes after the next take, regardless of earlier selections
    /// by shaders.
    pub fn record_select_none(&self, recorder: &mut Recorder<'_>) {
        recorder.barrier(Access::COMPUTE, Access::TRANSFER_WRITE);
        recorder.fill(&self.header, offset_of!(QueueHeader, selecting) as u64, 4, 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE);
    }

    /// Records a dispatch of one invocation per slot of `domain`, in workgroups of `QUEUE_GROUP_SIZE`;
    /// pipeline, sets and constants must be bound.
    pub fn record_dispatch(&self, recorder: &mut Recorder<'_>, domain: Domain) {
        match domain {
            Domain::First(count) if count > self.capacity => {
                recorder.refuse(&format!("{count} slots of a queue of {} were requested", self.capacity));
            }
            Domain::First(count) => recorder.dispatch([count.div_ceil(QUEUE_GROUP_SIZE), 1, 1]),
            Domain::Selected => {
                recorder.dispatch_indirect(&self.header, offset_of!(QueueHeader, selected_x) as u64);
            }
        }
    }

    /// Returns the number of slots.
    pub fn capacity(&self) -> u32 {
        self.capacity
    }

    /// Returns the queue's binding set.
    pub fn set(&self) -> &BindingSet {
        &self.set
    }

    /// Returns the layout of [`Self::set`].
    pub fn set_layout(&self) -> &SetLayout {
        &self.layout
    }

    /// Returns the buffer of the [`QueueHeader`], for reading. Shaders trust its counts, so nothing else may
    /// write them.
    pub fn header(&self) -> &Buffer {
        &self.header
    }

    /// Returns the buffer of the [`Ray`] per slot.
    pub fn rays(&self) -> &Buffer {
        &self.rays
    }

    /// Returns the buffer of the [`Hit`] per slot.
    pub fn hits(&self) -> &Buffer {
        &self.hits
    }

    /// Returns the buffer with the lists of slots, each with capacity for all slots: two of paused rays, then
    /// two of selected slots.
    pub fn list(&self) -> &Buffer {
        &self.list
    }

    /// Returns the buffer of the [`Surface`] per slot.
    pub fn surfaces(&self) -> &Buffer {
        &self.surfaces
    }

    /// Returns the buffer of the [`RayWork`] per slot, written by the last trace through a structure that
    /// counts per ray; a placeholder unless the queue was made with [`QueueParts::work`].
    pub fn work(&self) -> &Buffer {
        &self.work
    }

    /// Downloads the steps of slot 0 since the reset, and their number, which may exceed the capacity of the
    /// queue. Submits and waits: for tests and tools.
    ///
    /// # Errors
    /// The device failed.
    pub fn download_steps(&self, device: &Device) -> Result<(Vec<TraceStep>, u32), AdsError> {
        if self.step_capacity == 0 {
            return Ok((Vec::new(), 0));
        }
        let header = device.download_as::<u32>(&self.steps, 0, 2)?;
        let taken = header.get(1).copied().unwrap_or(0);
        let kept = taken.min(self.step_capacity) as usize;
        Ok((device.download_as::<TraceStep>(&self.steps, STEP_HEADER, kept)?, taken))
    }

    /// Returns the bytes of all buffers.
    pub fn bytes(&self) -> u64 {
        self.buffers().iter().map(|buffer| buffer.size()).sum()
    }

    /// Returns names and bytes of the buffers.
    pub fn bytes_by_part(&self) -> impl Iterator<Item = (&'static str, u64)> {
        const NAMES: [&str; BUFFERS] =
            ["header", "rays", "hits", "traversal states", "lists", "surfaces", "work", "steps"];
        NAMES.into_iter().zip(self.buffers().map(Buffer::size))
    }

    /// Downloads the sums over all traces since the reset. Submits and waits: for use after a trace, in tests
    /// and tools.
    ///
    /// # Errors
    /// The device failed.
    pub fn download_counters(&self, device: &Device) -> Result<QueueCounters, GpuError> {
        let header = device.download_as::<QueueHeader>(&self.header, 0, 1)?;
        Ok(header.first().map(Self::counters).unwrap_or_default())
    }

    /// Returns the counters in a downloaded header.
    pub fn counters(header: &QueueHeader) -> QueueCounters {
        let wide = |low: u32, high: u32| u64::from(low) | u64::from(high) << 32;
        QueueCounters {
            unfinished: header.unfinished,
            not_ready: header.not_ready,
            corrupted: header.corrupted.saturating_add(header.corrupted_before),
            cells: wide(header.cells_low, header.cells_high),
            entries: wide(header.entries_low, header.entries_high),
            tests: wide(header.tests_low, header.tests_high),
            views: wide(header.views_low, header.views_high),
            searched: wide(header.searched_low, header.searched_high),
        }
    }
}

/// Returns names and bytes of the buffers, in the order of bindings; 0 bytes for a placeholder.
pub(crate) fn sizes(capacity: u32, parts: QueueParts) -> [(&'static str, u64); BUFFERS] {
    let of = |element: usize, count: u64| element as u64 * count;
    let slots = u64::from(capacity);
    let where_asked = |is_asked: bool| if is_asked { slots } else { 0 };
    // A placeholder has capacity for no step.
    let steps =
        if parts.steps > 0 { STEP_HEADER + of(size_of::<TraceStep>(), parts.steps.into()) } else { 0 };
    [
        ("header", of(size_of::<QueueHeader>(), 1)),
        ("rays", of(size_of::<Ray>(), slots)),
        ("hits", of(size_of::<Hit>(), slots)),
        ("states", of(size_of::<TraceState>(), slots)),
        ("list", of(size_of::<u32>(), 4 * slots)),
        ("surfaces", of(size_of::<Surface>(), where_asked(parts.surfaces))),
        ("work", of(size_of::<RayWork>(), where_asked(parts.work))),
        ("steps", steps),
    ]
}

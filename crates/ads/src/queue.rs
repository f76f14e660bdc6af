//! Queues of rays on the device.

use std::mem::offset_of;

use rasray_gpu::{
    Access, BindingSet, Buffer, BufferDesc, BufferUsage, ComputePipeline, ComputePipelineDesc, Device,
    GpuError, MemoryLocation, Recorder, SetLayout,
};
use rasray_shaders_glsl::constants::contract::{DOMAIN_SELECTED, QUEUE_GROUP_SIZE};

use crate::{AdsError, Hit, QueueHeader, Ray, RayWork, Surface, TraceState, TraceStep};

/// Number of bindings of the queue set.
const BINDINGS: u32 = 8;

/// Bytes before the first step: the logged slot and the number of steps.
const STEP_HEADER: u64 = 8;

/// Which slots of a queue a pass works on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// The first n slots.
    First(u32),
    /// Those that shaders selected (`queue_select` of `ads/queue.glsl`) before the last [`RayQueue::record_take`], in no
    /// particular order: as many as the device counted, so that the pass costs nothing for the others.
    Selected,
}

impl Domain {
    /// What shaders are told: the number of first slots, or `DOMAIN_SELECTED`.
    pub fn word(self) -> u32 {
        match self {
            Self::First(count) => count,
            Self::Selected => DOMAIN_SELECTED,
        }
    }
}

/// What a queue holds in addition to rays, hits and states. A part that is not requested is a placeholder of 16 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct QueueParts {
    /// A [`Surface`] per slot.
    pub surfaces: bool,
    /// A [`RayWork`] per slot, written by structures that count per ray.
    pub work: bool,
    /// Capacity for [`TraceStep`]s of slot 0, written by structures that log steps.
    pub steps: u32,
}

/// Rays, hits, surfaces and traversal states of `capacity` slots, and lists of slots. Cheap to clone.
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

/// Sums over all traces since the last reset.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct QueueCounters {
    /// Rays given up after their last round.
    pub unfinished: u32,
    /// Rays traced while the structure was incomplete.
    pub not_ready: u32,
    /// List entries with an invalid index in the structure last traced, all its parts together, since it was built;
    /// anything but 0 is a fault.
    pub corrupted: u32,
    /// Cells stepped; zero unless counters are enabled.
    pub cells: u64,
    /// List entries read; zero unless counters are enabled.
    pub entries: u64,
    /// Primitives tested; zero unless counters are enabled.
    pub tests: u64,
}

impl RayQueue {
    /// Allocates a queue, with surfaces if requested.
    ///
    /// # Errors
    /// Out of memory, or a buffer exceeds what one binding can hold.
    pub fn new(device: &Device, name: &str, capacity: u32, surfaces: bool) -> Result<Self, AdsError> {
        Self::with_parts(device, name, capacity, QueueParts { surfaces, ..QueueParts::default() })
    }

    /// Allocates a queue with the requested parts.
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
        let buffer = |part: &str, element: usize, count: u64| {
            device.create_buffer(&BufferDesc {
                name: &format!("{name} {part}"),
                size: element as u64 * count,
                usage: BufferUsage::ALL,
                location: MemoryLocation::Device,
            })
        };
        let slots = u64::from(capacity);
        let header = buffer("header", size_of::<QueueHeader>(), 1)?;
        let rays = buffer("rays", size_of::<Ray>(), slots)?;
        let hits = buffer("hits", size_of::<Hit>(), slots)?;
        let states = buffer("states", size_of::<TraceState>(), slots)?;
        let list = buffer("list", size_of::<u32>(), 4 * slots)?;
        let surfaces = buffer("surfaces", size_of::<Surface>(), if parts.surfaces { slots } else { 0 })?;
        let work = buffer("work", size_of::<RayWork>(), if parts.work { slots } else { 0 })?;
        // The placeholder's 16 bytes hold no step.
        let step_bytes = u64::from(parts.steps) * size_of::<TraceStep>() as u64;
        let steps = buffer("steps", 1, if parts.steps > 0 { STEP_HEADER + step_bytes } else { 0 })?;
        let layout = Self::layout(device)?;
        let set = device.create_binding_set(
            &layout,
            name,
            &[&header, &rays, &hits, &states, &list, &surfaces, &work, &steps],
        )?;
        let shader = &rasray_shaders_glsl::ADS_QUEUE_TAKE;
        let take = device.create_compute_pipeline(&ComputePipelineDesc {
            name: shader.name,
            spirv: &shader.words(),
            sets: &[&layout],
            push_constant_bytes: 0,
            constants: &[],
        })?;
        Ok(Self {
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
            step_capacity: parts.steps,
            layout,
            set,
        })
    }

    /// The layout that all queues share.
    ///
    /// # Errors
    /// Out of memory.
    pub fn layout(device: &Device) -> Result<SetLayout, AdsError> {
        Ok(device.create_set_layout("ray queue", BINDINGS)?)
    }

    /// Clears counters and book-keeping; to be recorded once before a queue is first used, and again
    /// whenever counters are to start anew.
    pub fn record_reset(&self, recorder: &mut Recorder<'_>) {
        let size = size_of::<QueueHeader>() as u64;
        recorder.barrier(Access::ALL, Access::TRANSFER_WRITE);
        recorder.fill(&self.header, 0, size, 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::TRANSFER_WRITE);
        recorder.fill(&self.header, offset_of!(QueueHeader, capacity) as u64, 4, self.capacity);
        // Slot 0 is logged; no slot where the capacity is 0.
        let logged = if self.step_capacity > 0 { 0 } else { u32::MAX };
        recorder.fill(&self.steps, 0, 4, logged);
        recorder.fill(&self.steps, 4, 4, 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE | Access::TRANSFER);
    }

    /// Records that the slots selected so far are those of [`Domain::Selected`] from now on, and that a new selection
    /// begins. Shaders that selected them came before it, and a barrier towards compute shaders between.
    pub fn record_take(&self, recorder: &mut Recorder<'_>) {
        recorder.bind_compute(&self.take);
        recorder.bind_sets(0, &[&self.set]);
        recorder.dispatch([1, 1, 1]);
        recorder.barrier(Access::COMPUTE, Access::COMPUTE | Access::INDIRECT_READ | Access::TRANSFER);
    }

    /// Records that no slot is selected for the passes after the next take, whatever shaders selected before.
    pub fn record_select_none(&self, recorder: &mut Recorder<'_>) {
        recorder.barrier(Access::COMPUTE, Access::TRANSFER_WRITE);
        recorder.fill(&self.header, offset_of!(QueueHeader, selecting) as u64, 4, 0);
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE);
    }

    /// Records a dispatch of one invocation per slot of `domain`, in workgroups of `QUEUE_GROUP_SIZE`; pipeline, sets and
    /// constants are bound.
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

    /// Slots.
    pub fn capacity(&self) -> u32 {
        self.capacity
    }

    /// The queue's binding set.
    pub fn set(&self) -> &BindingSet {
        &self.set
    }

    /// The layout of [`Self::set`].
    pub fn set_layout(&self) -> &SetLayout {
        &self.layout
    }

    /// [`QueueHeader`].
    pub fn header(&self) -> &Buffer {
        &self.header
    }

    /// [`Ray`] per slot.
    pub fn rays(&self) -> &Buffer {
        &self.rays
    }

    /// [`Hit`] per slot.
    pub fn hits(&self) -> &Buffer {
        &self.hits
    }

    /// Lists of slots, each as long as there are slots: two of paused rays, then two of those selected.
    pub fn list(&self) -> &Buffer {
        &self.list
    }

    /// [`Surface`] per slot.
    pub fn surfaces(&self) -> &Buffer {
        &self.surfaces
    }

    /// [`RayWork`] per slot, after the last trace through a structure that counts per ray; a placeholder
    /// unless the queue was made with [`QueueParts::work`].
    pub fn work(&self) -> &Buffer {
        &self.work
    }

    /// The steps of slot 0 since the reset, and how many there were, which may be more than the queue has capacity
    /// for. Submits and waits: for tests and tools.
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

    /// Bytes of all buffers.
    pub fn bytes(&self) -> u64 {
        [
            &self.header,
            &self.rays,
            &self.hits,
            &self.states,
            &self.list,
            &self.surfaces,
            &self.work,
            &self.steps,
        ]
        .iter()
        .map(|buffer| buffer.size())
        .sum()
    }

    /// Sums over all traces since the reset. Submits and waits: for use after a trace, in tests and tools.
    ///
    /// # Errors
    /// The device failed.
    pub fn download_counters(&self, device: &Device) -> Result<QueueCounters, GpuError> {
        let header = device.download_as::<QueueHeader>(&self.header, 0, 1)?;
        Ok(header.first().map(Self::counters).unwrap_or_default())
    }

    /// What a downloaded header says.
    pub fn counters(header: &QueueHeader) -> QueueCounters {
        let wide = |low: u32, high: u32| u64::from(low) | u64::from(high) << 32;
        QueueCounters {
            unfinished: header.unfinished,
            not_ready: header.not_ready,
            corrupted: header.corrupted.saturating_add(header.corrupted_before),
            cells: wide(header.cells_low, header.cells_high),
            entries: wide(header.entries_low, header.entries_high),
            tests: wide(header.tests_low, header.tests_high),
        }
    }
}

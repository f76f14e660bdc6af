//! Vulkan layer of rasray: devices, memory, buffers, pipelines, recorded commands and timings. All crates
//! that run on a device use it. It contains no code for scenes, windows or ray-tracing structures, and it
//! works on the device of a host that has its own renderer.
//!
//! - [`Device`] is a device with one queue, made here ([`Device::create`]) or handed in
//!   ([`Device::from_raw`]).
//! - [`Buffer`] is memory of the device, made here or wrapped ([`Device::buffer_from_raw`]).
//! - [`Recorder`] records passes into a command buffer, of a submission of this crate or of a host.
//! - [`Flights`] submits frame after frame without waiting.
//! - [`GpuError`] is the error of every call.
//!
//! # Contracts
//!
//! **Who owns what.** [`Device::create`] owns instance, device and queue. [`Device::from_raw`] owns none of
//! them: the host keeps all objects that it hands in, and destroys them after the last object made from the
//! [`Device`] is dropped. Buffers, set layouts, binding sets, pipelines and timers are cheap handles to
//! reference-counted values; each keeps its device alive, a binding set also keeps its buffers and layout, a
//! pipeline its set layouts. A value is destroyed when its last handle is dropped, so objects that a pending
//! command buffer uses must outlive it. Pipelines made from equal descriptions are shared;
//! [`Device::keep_pipelines`] keeps some that are not in use.
//!
//! **Who waits.** A [`Recorder`] only records: it never submits, never waits, never allocates device memory.
//! [`Device::submit`], [`Device::upload`], [`Device::download`] and [`Device::create_cleared_buffer`] submit
//! and wait with a timeout; they are for applications, tests and objects that are made before frames begin.
//! [`Flights`] submits without waiting, frame after frame. Code that runs inside the frame of a host uses a
//! [`Recorder`] alone. Submissions keep the objects that they use alive until the device has finished with
//! them.
//!
//! **Synchronisation.** Within one command buffer the caller records [`Recorder::barrier`]. Every submission
//! of [`Device::submit`] begins with a barrier against all earlier ones and ends with one towards host reads.
//!
//! **Ranges of buffers** have one user at a time, see [below](#ranges-of-buffers).
//!
//! **Errors.** Creation returns [`GpuError`]. Recording does not return errors: the recorder keeps the first
//! mistake and ignores all later commands, and [`Recorder::finish`] or the submission reports the mistake.
//!
//! **After a timeout** the device may still be running the work. The device is then *abandoned*: objects made
//! from it are not destroyed any more, and every later submission fails with [`GpuError::Abandoned`].
//!
//! **Threads.** All types except [`Recorder`] can be shared between threads. Submissions are serialised.
//!
//! **Validation** is requested when the device is made, and reports warnings and errors through `tracing` and
//! [`Device::validation_messages`]. The environment variable
//! `VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT` enables synchronisation
//! checks.
//!
//! # Ranges of buffers
//!
//! The host ([`Buffer::write`], [`Buffer::read_into`], [`Buffer::read`]) and recorded commands use the same
//! memory. Callers must keep these rules:
//!
//! - The host writes a range only while no pending work uses it, and reads it only while no pending work
//!   writes it.
//! - Work is pending from its submission until its fence is signalled. [`Device::submit`] waits for that;
//!   with [`Flights`] and submissions of a host the caller waits.
//! - Before the host reads, the work must have made its writes visible to the host, as submissions of
//!   [`Device::submit`] do at their end.
//! - Ranges that do not overlap are independent. Threads of the host exclude each other: each access locks
//!   the buffer.
//!
//! Nothing checks these rules, but the functions are safe nevertheless: they copy plain bytes under a lock,
//! stay within the buffer and return no reference into it. In a race the host reads old bytes, new bytes or a
//! mix, and so do shaders; no other memory of the host is affected. Shaders treat the mix like any other
//! bytes that were written there. Hosts that mark every function as unsafe whose misuse gives wrong bytes
//! have to wrap these functions.
//!
//! # Example
//!
//! ```no_run
//! use rasray_gpu::*;
//! # fn main() -> Result<(), GpuError> {
//! let device = Device::create(&DeviceDesc::default())?;
//! let buffer = device.create_buffer(&BufferDesc {
//!     name: "values",
//!     size: 1024,
//!     usage: BufferUsage::STORAGE | BufferUsage::TRANSFER_DST | BufferUsage::TRANSFER_SRC,
//!     location: MemoryLocation::Device,
//! })?;
//! device.submit(|recorder| {
//!     recorder.begin_pass(Stage::Build, "clear");
//!     recorder.fill(&buffer, 0, buffer.size(), 7);
//!     recorder.end_pass();
//! })?;
//! assert!(device.download_as::<u32>(&buffer, 0, 256)?.iter().all(|&value| value == 7));
//! # Ok(()) }
//! ```

mod access;
mod binding;
mod buffer;
mod choose;
mod device;
mod device_core;
mod driver_tree;
mod error;
#[cfg(feature = "fault-injection")]
pub mod faults;
mod features;
mod flights;
mod instance;
mod limits;
mod memory;
mod messages;
mod one_time;
mod pipeline;
mod pipeline_desc;
mod pipeline_store;
mod queue;
mod raster_options;
mod raw;
mod recorder;
mod requirements;
mod set_layout;
mod set_parts;
mod shader_stage;
mod stage;
mod timers;
mod transfer;

pub use access::Access;
pub use ash;
pub use ash::vk;
pub use binding::{BindingSet, BufferRange};
pub use buffer::{Buffer, BufferDesc, BufferUsage, RawBuffer};
pub use choose::{DeviceKind, DeviceSummary};
pub use device::{Device, DeviceDesc};
pub use driver_tree::{DRIVER_BOX_BYTES, DriverTree, DriverTreeDesc, DriverTreeGoal};
pub use error::{GpuError, Result};
pub use features::Feature;
pub use flights::Flights;
pub use limits::Limits;
pub use memory::{Allocation, Memory, MemoryLocation, PooledMemory};
pub use messages::ValidationLog;
pub use pipeline::{ComputePipeline, RasterPipeline};
pub use pipeline_desc::{ComputePipelineDesc, RasterPipelineDesc};
pub use queue::{SubmitOptions, Submitted};
pub use rasray_spirv::{TrustedModule, storage_buffers_used};
pub use raster_options::RasterOptions;
pub use raw::RawDevice;
pub use recorder::{PassCommands, Recorded, Recorder, RenderArea};
pub use requirements::Requirements;
pub use set_layout::SetLayout;
pub use stage::{Stage, TraceMode};
pub use timers::{PassTiming, TimerKind, Timers, Timing};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

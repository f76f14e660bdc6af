//! Errors of structures and queues.

use rasray_gpu::GpuError;

/// Error of a structure, a geometry or a queue that could not be made, resized, built or traced.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AdsError {
    /// The Vulkan layer failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A build was recorded for a slot that does not exist; or of frames, one was recorded for a slot whose
    /// last one was not finished, or finished in another order than they were recorded in, or without having
    /// been recorded.
    #[error(
        "{structure}: slot {slot} of {slots} cannot be used now: slots count from 0, `set_slots` sets how many there are, \
         and frames are finished once each, in the order in which they were recorded, before their slot is recorded again"
    )]
    Slot {
        /// The structure.
        structure: &'static str,
        /// The requested slot, from 0.
        slot: u32,
        /// Number of slots.
        slots: u32,
    },
    /// First hits of camera rays were asked for, and the structure has no view of the camera to take them
    /// from.
    #[error("{structure} has no view of the camera that first hits could be taken from: trace camera rays")]
    NoFirstHits {
        /// The structure.
        structure: &'static str,
    },
    /// An option has a value outside its range.
    #[error("{option} is {value}: {expected}")]
    Option {
        /// Name of the option.
        option: &'static str,
        /// The value that was given.
        value: String,
        /// Possible values, in words.
        expected: &'static str,
    },
    /// A pool needs more elements than its indices can address.
    #[error(
        "{structure}: pool `{pool}` needs {elements} elements, more than its 32-bit indices can address; lower the \
         resolution or split the scene"
    )]
    PoolTooLarge {
        /// Name of the structure.
        structure: &'static str,
        /// Name of the pool.
        pool: &'static str,
        /// Elements needed.
        elements: u64,
    },
    /// A shader module is not compiled in.
    #[error(
        "{structure}: the shader module `{module}` is not compiled in; modules that read a scene need the cargo feature \
         `scene`"
    )]
    ModuleMissing {
        /// Name of the structure.
        structure: &'static str,
        /// Name of the module.
        module: String,
    },
    /// Surfaces were requested from a structure that was made without a scene.
    #[error("{structure} was created without a scene binding, so it cannot resolve surfaces")]
    NoScene {
        /// Name of the structure.
        structure: &'static str,
    },
    /// Pipelines cannot read a scene that is to take the place of the one that they were made for.
    #[error(
        "{structure} cannot take this scene: its {what} differ from those of the scene that it was made for"
    )]
    OtherScene {
        /// Name of the structure.
        structure: &'static str,
        /// Buffers, alpha masks or specialisation constants, which differ.
        what: &'static str,
    },
    /// A geometry's counts or bounds do not describe its buffers.
    #[error("the geometry cannot be used: {reason}")]
    Geometry {
        /// Fault of the counts, ranges or bounds, with its numbers.
        reason: String,
    },
    /// Buffers that a queue of rays cannot be made of.
    #[error("the queue cannot be made: {reason}")]
    Queue {
        /// Buffer, and the flag or size that it lacks.
        reason: String,
    },
    /// Structures that are no two parts of one, or that were not given what their parts need.
    #[error("{structure} cannot be in parts: {reason}")]
    InParts {
        /// Name of the structure.
        structure: &'static str,
        /// Why not.
        reason: &'static str,
    },
    /// A build found triangles that its geometry does not allow.
    #[error(
        "{triangles} triangles have a corner outside of the bounds that the geometry states, have an invalid vertex \
         index, or exceed its maximum: state bounds that hold all positions, indices below the number of vertices, \
         and a maximum that the device's count of triangles does not exceed"
    )]
    OutsideBounds {
        /// Number of such triangles.
        triangles: u32,
    },
    /// Lists that were read back are damaged.
    #[error("the lists of {structure} cannot be counted: {fault}")]
    Damaged {
        /// Name of the structure.
        structure: &'static str,
        /// Fault of the lists.
        fault: String,
    },
    /// A build was recorded without the host's part.
    #[error("{structure} is built by the host first: call prepare_build before every record_build")]
    NotPrepared {
        /// Name of the structure.
        structure: &'static str,
    },
}

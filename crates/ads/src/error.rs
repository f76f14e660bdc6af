//! Errors of structures and queues.

use rasray_gpu::GpuError;

/// Error of a structure, a geometry or a queue that could not be made, resized, built or traced.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AdsError {
    /// The Vulkan layer failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A slot was used against the rules. Either a build was recorded for a slot that does not exist; or, of
    /// frames, one was recorded for a slot whose last frame was not finished, was finished in another order
    /// than that of recording, or was finished without having been recorded.
    #[error(
        "{structure}: slot {slot} of {slots} cannot be used now: slots count from 0, `set_slots` sets how many there are, \
         and frames are finished once each, in the order in which they were recorded, before their slot is recorded again"
    )]
    Slot {
        /// Name of the structure.
        structure: &'static str,
        /// The requested slot, from 0.
        slot: u32,
        /// Number of slots.
        slots: u32,
    },
    /// First hits of camera rays were requested from a structure without a view of the camera.
    #[error("{structure} has no view of the camera that first hits could be taken from: trace camera rays")]
    NoFirstHits {
        /// Name of the structure.
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
        "{structure}: pool `{pool}` needs {elements} elements, of which at most {limit} can be addressed; lower the \
         structure's resolution, where it has one, or split the scene"
    )]
    PoolTooLarge {
        /// Name of the structure.
        structure: &'static str,
        /// Name of the pool.
        pool: &'static str,
        /// Number of elements needed.
        elements: u64,
        /// Greatest number of elements of this pool.
        limit: u64,
    },
    /// Sizes name other pools than the structure has.
    #[error(
        "{structure}: the sizes are not those of its pools ({pools}): change the sizes that the structure returns"
    )]
    OtherPools {
        /// Name of the structure.
        structure: &'static str,
        /// Names of the structure's pools, with commas between them.
        pools: String,
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
    /// A scene cannot replace the one that the structure was made for, because the pipelines cannot read it.
    #[error(
        "{structure} cannot take this scene: its {what} differ from those of the scene that it was made for"
    )]
    OtherScene {
        /// Name of the structure.
        structure: &'static str,
        /// Property that differs: buffers, alpha masks or specialisation constants.
        what: &'static str,
    },
    /// The counts or bounds of a geometry do not describe its buffers.
    #[error("the geometry cannot be used: {reason}")]
    Geometry {
        /// Fault of the counts, ranges or bounds, with its numbers.
        reason: String,
    },
    /// A queue of rays cannot be made of the given buffers.
    #[error("the queue cannot be made: {reason}")]
    Queue {
        /// Name of the buffer, and the flag or size that it lacks.
        reason: String,
    },
    /// Structures cannot be the parts of one structure, or were not given the data that their parts need.
    #[error("{structure} cannot be in parts: {reason}")]
    InParts {
        /// Name of the structure.
        structure: &'static str,
        /// Reason, in words.
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
    /// A build was recorded before the host did its part of it.
    #[error("{structure} is built by the host first: call prepare_build before every record_build")]
    NotPrepared {
        /// Name of the structure.
        structure: &'static str,
    },
}

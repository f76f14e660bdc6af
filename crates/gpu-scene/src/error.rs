//! What can go wrong while a scene is packed and uploaded.

/// Errors of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GpuSceneError {
    /// More vertices or indices than 32-bit numbers reach.
    #[error(
        "the scene has {count} posed vertices or indices, more than the {limit} that 32-bit indices reach; split the scene or instance less"
    )]
    TooManyVertices {
        /// Demand.
        count: u64,
        /// Largest number that works.
        limit: u64,
    },
    /// The texels of all images with their smaller levels exceed what the device holds, or what 32 bits number.
    #[error(
        "the textures need {count} texels with all levels, more than the {limit} that can be held; use smaller or fewer images"
    )]
    TooManyTexels {
        /// Demand.
        count: u64,
        /// Largest number that works.
        limit: u64,
    },
    /// An index of the scene points past the end of what it indexes.
    #[error("{what}, but the scene has only {limit} of them; check the scene before it is uploaded")]
    Malformed {
        /// Who names what.
        what: String,
        /// How many there are.
        limit: usize,
    },
    /// The device refused.
    #[error(transparent)]
    Gpu(#[from] rasray_gpu::GpuError),
    /// The geometry could not be bound.
    #[error(transparent)]
    Ads(#[from] rasray_ads::AdsError),
    /// What deforms the scene is no clip: only the host knows its shapes.
    #[error("{scene} is simulated, or in numbered files: pose it on the host (Scene::at) and upload it anew")]
    DeformedByHost {
        /// Name of the scene.
        scene: String,
    },
}

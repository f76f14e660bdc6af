//! Errors of packing and uploading a scene.

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
    /// The texels of all images with their smaller levels exceed what the device holds, or what 32 bits
    /// number.
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
        /// Length of the list that is indexed.
        limit: usize,
    },
    /// The device refused.
    #[error(transparent)]
    Gpu(#[from] rasray_gpu::GpuError),
    /// The geometry could not be bound.
    #[error(transparent)]
    Ads(#[from] rasray_ads::AdsError),
    /// A mesh has other triangles, coordinates of textures or colours than those on the device.
    #[error(
        "mesh {mesh} of {scene} has other triangles at {seconds} s than those on the device, which a pose cannot change"
    )]
    OtherTriangles {
        /// Name of the scene.
        scene: String,
        /// Index into its meshes.
        mesh: usize,
        /// When.
        seconds: f64,
    },
    /// A rig deforms a mesh, and so does a simulation or a numbered file.
    #[error(
        "mesh {mesh} of {scene} is deformed by a rig and by a deformer, and one of both can be posed on the device"
    )]
    DeformedTwice {
        /// Name of the scene.
        scene: String,
        /// Name of the mesh.
        mesh: String,
    },
    /// A deformer of the scene failed.
    #[error(transparent)]
    Scene(#[from] rasray_scene::SceneError),
}

//! Errors of packing and uploading a scene.

/// Errors of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GpuSceneError {
    /// More vertices or indices than 32-bit numbers can count.
    #[error(
        "the scene has {count} posed vertices or indices, more than the {limit} that 32-bit indices reach; split the scene or instance less"
    )]
    TooManyVertices {
        /// Number that is needed.
        count: u64,
        /// Largest number that works.
        limit: u64,
    },
    /// The texels of all images with their smaller levels exceed the memory of the device, or the range of
    /// 32-bit numbers.
    #[error(
        "the textures need {count} texels with all levels, more than the {limit} that can be held; use smaller or fewer images"
    )]
    TooManyTexels {
        /// Number that is needed.
        count: u64,
        /// Largest number that works.
        limit: u64,
    },
    /// An index of the scene points past the end of its list.
    #[error("{what}, but the scene has only {limit} of them; check the scene before it is uploaded")]
    Malformed {
        /// Element that holds the index, and the element that it names.
        what: String,
        /// Length of the indexed list.
        limit: usize,
    },
    /// A call to the device failed.
    #[error(transparent)]
    Gpu(#[from] rasray_gpu::GpuError),
    /// The geometry could not be bound.
    #[error(transparent)]
    Ads(#[from] rasray_ads::AdsError),
    /// A mesh has other triangles, texture coordinates or colours than the one on the device.
    #[error(
        "mesh {mesh} of {scene} has other triangles at {seconds} s than those on the device, which a pose cannot change"
    )]
    OtherTriangles {
        /// Name of the scene.
        scene: String,
        /// Index into its meshes.
        mesh: usize,
        /// Time of the pose, seconds.
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

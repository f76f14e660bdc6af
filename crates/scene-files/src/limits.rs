//! Limits of the memory that a scene file may ask for, and the choice of a scene in the file.

use std::path::Path;

use rasray_scene::SceneError;

/// Upper bounds that are checked before memory is spent. The defaults admit every scene that fits a
/// large workstation and refuse files that are small but ask for a lot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Largest number of bytes of the scene file, of each file that it refers to, of each decoded `data:`
    /// URI, and of all buffers together, decoded ones included.
    pub file_bytes: u64,
    /// Largest number of triangles placed in the world; every instance counts.
    pub triangles: u64,
    /// Largest number of elements of one vertex or index array.
    pub vertices: u64,
    /// Largest number of elements of all vertex, index and animation arrays together, counted each time one
    /// is read: a small file may refer to the same array many times.
    pub elements: u64,
    /// Largest number of texels of one image.
    pub image_pixels: u64,
    /// Largest number of texels of all images together.
    pub total_pixels: u64,
    /// Largest number of nodes of a scene graph.
    pub nodes: u64,
    /// Largest number of placed meshes.
    pub instances: u64,
    /// Largest number of nodes on the path from a root to a leaf.
    pub depth: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            file_bytes: 4 << 30,
            triangles: 1 << 27,
            vertices: 1 << 27,
            elements: 1 << 29,
            image_pixels: 1 << 28,
            total_pixels: 1 << 30,
            nodes: 1 << 20,
            instances: 1 << 22,
            depth: 512,
        }
    }
}

impl Limits {
    /// Returns an error if `found` exceeds `limit`, which is the field called `option`.
    ///
    /// # Errors
    /// [`SceneError::TooLarge`], naming `what` and `option`.
    pub(crate) fn check(
        path: &Path,
        what: &str,
        found: u64,
        limit: u64,
        option: &'static str,
    ) -> Result<(), SceneError> {
        if found > limit {
            return Err(SceneError::too_large(path, what, found, limit, option));
        }
        Ok(())
    }
}

/// Choice of a scene in a file with several. Formats with one scene ignore it.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub enum SceneChoice {
    /// The default scene of the file; else its first; else all nodes without a parent.
    #[default]
    Default,
    /// The scene with this index, from 0.
    Index(usize),
    /// The first scene with this name.
    Name(String),
}

/// Options of loading a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadOptions {
    /// Limits of the memory that a file may ask for.
    pub limits: Limits,
    /// Choice of the scene in the file.
    pub scene: SceneChoice,
    /// Frames per second of a sequence of files, above 0.
    pub fps: f64,
}

impl LoadOptions {
    /// Default frames per second of a sequence of files.
    pub const FPS: f64 = 25.0;
}

impl Default for LoadOptions {
    fn default() -> Self {
        Self { limits: Limits::default(), scene: SceneChoice::default(), fps: Self::FPS }
    }
}

//! Limits of what a scene file may ask for, and the choice of a scene of it.

use std::path::Path;

use rasray_scene::SceneError;

/// Upper bounds that are checked before memory is spent. The defaults admit every scene that fits a
/// large workstation and refuse files that are small but ask for a lot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of the scene file, of each file it refers to, of each decoded `data:` URI, and of all buffers
    /// together, those that are decoded included.
    pub file_bytes: u64,
    /// Triangles placed in the world: those of every instance count.
    pub triangles: u64,
    /// Elements of one vertex or index array.
    pub vertices: u64,
    /// Elements of all vertex, index and animation arrays together, counted each time one is read:
    /// a small file may refer to the same array many times.
    pub elements: u64,
    /// Texels of one image.
    pub image_pixels: u64,
    /// Texels of all images together.
    pub total_pixels: u64,
    /// Nodes of a scene graph.
    pub nodes: u64,
    /// Placed meshes.
    pub instances: u64,
    /// Nodes on the longest path from a root to a leaf.
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
    /// Refuses `found` where it exceeds `limit`, the field called `option`.
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

/// Choice of the scene of a file with several. Formats with one scene ignore it.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub enum SceneChoice {
    /// The default scene of the file; else its first; else all nodes without a parent.
    #[default]
    Default,
    /// By position, from 0.
    Index(usize),
    /// By name; the first of that name.
    Name(String),
}

/// Options of loading a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadOptions {
    /// Limits of what a file may ask for.
    pub limits: Limits,
    /// Scene of the file.
    pub scene: SceneChoice,
    /// Frames per second of a sequence of files, above 0.
    pub fps: f64,
}

impl LoadOptions {
    /// Frames per second unless told.
    pub const FPS: f64 = 25.0;
}

impl Default for LoadOptions {
    fn default() -> Self {
        Self { limits: Limits::default(), scene: SceneChoice::default(), fps: Self::FPS }
    }
}

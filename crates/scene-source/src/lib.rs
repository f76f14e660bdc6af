//! From a name to a scene that can be shown: the file or the built-in scene of that name, its moment, its light and the
//! camera that looks at it, with a hash of everything that it was made from. No device is needed.
//!
//! ```
//! let mut loaded = rasray_scene_source::load("cornell".as_ref())?;
//! loaded.light(None);
//! let view = loaded.default_view()?;
//! println!("{}: {} triangles, seen from {}", loaded.scene.name, loaded.triangles, view.described());
//! # Ok::<(), rasray_scene_source::LoadError>(())
//! ```

mod camera;
mod error;
mod key_hash;
mod lighting;
mod loaded;

pub use camera::{Chosen, default_view, named_view, placed_view};
pub use error::LoadError;
pub use key_hash::KeyHash;
pub use loaded::{LoadedScene, load, load_with};

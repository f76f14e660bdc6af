//! Scenes by name: a file or a built-in scene, at a moment, lit, and with a camera that looks at it. The
//! command, the viewer and the benches load scenes with this crate, which needs no device.
//!
//! - [`load()`] and [`load_with`] make a [`LoadedScene`]: the scene, its light and its default view, with a
//!   hash of all its sources ([`KeyHash`]).
//! - [`default_view`], [`named_view`] and [`placed_view`] choose the camera.
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

pub use camera::{ChosenCamera, default_view, named_view, placed_view};
pub use error::LoadError;
pub use key_hash::KeyHash;
pub use loaded::{LoadedScene, load, load_with};

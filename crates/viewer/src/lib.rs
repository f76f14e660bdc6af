//! A viewer of scenes: the structures and integrators of `rasray render`, live. The command `rasray view`
//! opens it.
//!
//! - [`Session`] holds the choices of a user, and turns keys, drags and widgets into [`Settings`].
//! - [`Engine`] makes pictures of settings on a device, step by step, and repeats only what a change makes
//!   necessary ([`Redo`]).
//! - [`Worker`] runs an engine in a thread, so that a window never waits for a build.
//! - `run`, with the feature `window`, opens the window. All other types work without one.
//!
//! The picture that refinement ends at is the one that `rasray render` writes for the session's command line,
//! bit by bit.

mod camera_control;
mod command_line;
mod denoising;
mod engine;
mod error;
mod option_controls;
mod picked;
mod picture;
mod picture_view;
mod playback;
mod preview;
mod preview_size;
mod rate;
mod scene_at_time;
mod session;
mod settings;
mod traced;
mod viewer;
#[cfg(feature = "window")]
mod window;
mod worker;

pub use camera_control::{CameraControl, Rounded, Side};
pub use command_line::quoted;
pub use engine::{Engine, SceneSource, Step};
pub use error::ViewerError;
pub use option_controls::{Control, SystemChoice};
pub use picked::{Answer, Pick, Picked, PickedHit, PickedTriangle};
pub use picture::{Legend, Picture, Pixels};
pub use picture_view::{Area, PictureView};
pub use playback::Playback;
pub use preview_size::PreviewSize;
pub use rate::Rate;
pub use scene_at_time::ChooseCamera;
pub use session::{Explain, Failure, Opening, Session, camera_names};
pub use settings::{Redo, Settings, Shown, Standpoint};
pub use viewer::{OpenScene, Viewer};
#[cfg(feature = "window")]
pub use window::{End, SavePicture, SavedPicture, Viewing, check_display, run};
pub use worker::{Opened, Update, Worker};

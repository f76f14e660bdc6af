//! A window for scenes: the same structures and integrators as `rasray render`, live.
//!
//! A viewer works here without a window: a [`Session`] holds what was chosen and turns keys, drags and widgets into
//! [`Settings`]; an [`Engine`] makes pictures of settings on a device, step by step, and repeats only what a change makes
//! necessary ([`Redo`]); a [`Worker`] runs it in a thread, so that a window never waits for a build. The picture that
//! refinement ends at is the one that `rasray render` writes for the session's command line, bit by bit.
//!
//! With the feature `window`, `run` opens the window.

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

//! The frame loop: pose → build → trace, surfaces, shade → film, recorded in one go, several frames in flight.
//!
//! [`FrameRenderer`] submits a frame with a view and a pose of its own, and hands out finished pictures in order. A frame
//! records a build only where something changed that the structure depends on; one whose build was not complete, or whose
//! rays did not all finish, is never a picture. [`render_in_order`] repeats such frames: for images that are written.
//! Interactive programs leave them out, and keep showing the last picture.
//!
//! [`ImageRenderer`] makes an image wave by wave, with the same passes ([`ImagePasses`]): where a submission must not last as
//! long as an image, or somebody wants to look at it in between. It can take more samples where there is more noise
//! ([`Adaptive`]).
//!
//! Where triangles change in number, a frame brings another [`FrameScene`].
//!
//! Structures alone, with a host's own frames: `rasray_tracer::FrameStructure`.

mod adaptive;
mod error;
mod image_passes;
mod image_renderer;
mod in_order;
mod moments;
mod readback;
mod renderer;
mod samples;
mod scene;

pub use adaptive::Adaptive;
pub use error::FrameError;
pub use image_passes::ImagePasses;
pub use image_renderer::{Advance, ImageRenderer};
pub use in_order::{InOrder, render_in_order};
pub use readback::FilmCopy;
pub use renderer::{FrameInput, FrameRenderer, Picture, Taken};
pub use samples::Samples;
pub use scene::FrameScene;

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

//! Frames and images of a scene: pose, build, trace, surfaces, shade, film. The command, the viewer and the
//! benches make all pictures with this crate.
//!
//! - [`FrameRenderer`] renders frames of a moving scene, several in flight: it submits each frame with its
//!   own view and pose, and returns finished pictures in order.
//! - [`render_in_order`] drives it for images that are written to files: it repeats incomplete frames.
//! - [`ImageRenderer`] renders one image wave by wave, with the same passes ([`ImagePasses`]): for images
//!   that are too long for one submission, or that somebody watches.
//! - [`Adaptive`] takes more samples where there is more noise.
//! - [`FrameScene`] is a scene that frames show. A frame whose number of triangles changes brings another
//!   scene.
//!
//! A frame records a build only if something changed that the structure depends on. A frame is incomplete if
//! its build did not complete or its rays did not all finish; it never becomes a picture. Interactive
//! programs skip incomplete frames and keep showing the last picture.
//!
//! Hosts that have frames of their own and need only the structures use `rasray_tracer::FrameStructure`.

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
pub use renderer::{FrameInput, FrameRenderer, FrameResult, Picture};
pub use samples::Samples;
pub use scene::FrameScene;

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

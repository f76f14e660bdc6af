//! Modules of SPIR-V, reduced to what runs.
//!
//! GLSL files are included whole, and switches are specialisation constants, so most of a module never runs
//! in a given pipeline. Drivers drop it too, but many of them only after they have copied every function to
//! every call. [`specialised`] drops it before the driver sees it, with the values of the constants.
//!
//! Functions take modules as words. None panics for words that are not a module. A [`TrustedModule`] holds
//! words that somebody vouches for.

mod bindings;
mod flow;
mod fold;
mod instruction;
mod reduce;
mod specialise;
mod trusted;

pub use bindings::{NotAModule, check_header, storage_buffers_used, used_bindings};
pub use reduce::{only_reached, without_debug_text};
pub use specialise::specialised;
pub use trusted::TrustedModule;

/// Compiles the example of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

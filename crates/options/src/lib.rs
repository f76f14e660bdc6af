//! Options as data. Systems and integrators list their options as rows; the command line, its help, the
//! pages, the sweeps and the viewer's controls are made from these rows.
//!
//! - [`OptionRow`] is an option: its name, the [`Values`] that it takes, its help. Only the row states the
//!   option's range, and only the row converts text to a [`Value`].
//! - [`OptionValues`] are the values that were given for some options.
//! - [`text`] reads numbers, for options and other arguments.

mod row;
pub mod text;
mod value;
mod values;

pub use row::{OptionRow, ValueError};
pub use value::{OptionValues, Value};
pub use values::{Least, NotTaken, Unit, Values, Word};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

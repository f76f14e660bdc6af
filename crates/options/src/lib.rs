//! Options as data. An [`OptionRow`] says what an option is called, what it takes and what it is for; it is the only place
//! where a range stands, and where text becomes a [`Value`]. Systems and integrators list rows; command line, help, pages,
//! sweeps and controls are made from them. [`OptionValues`] is what was given of them. [`text`] reads the numbers of both
//! options and other arguments.

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

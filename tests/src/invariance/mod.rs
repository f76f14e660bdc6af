//! Which options may change a hit, as data, and what it takes to hold every system against it.
//!
//! Structures that find triangles give the same bits whatever their options. Structures that store
//! fragments give the same bits under everything that only arranges what they store. Any other change is
//! a bug. A new option is one row of [`LAWS`]; a test asserts that none is missing.

mod choices;
mod laws;
mod pairs;
mod scene;
mod subject;

pub use choices::{choices, speed_options, takes};
pub use laws::{LAWS, Law, Value, law};
pub use pairs::{Pair, Pairs, pairwise};
pub use scene::{EYE, assert_same, general_rays, ray_count, rays, scene};
pub use subject::{Answers, Row, SUBJECTS, Subject, first_difference};

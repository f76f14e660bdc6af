//! Checks every system against the registry's rules of options, which tell the options that may change a hit.
//!
//! Structures that find triangles give equal bits whatever their options. Structures that store fragments
//! give equal bits under every option that only arranges their data. Any other change is a bug. The rows are
//! [`rasray_systems::OPTIONS`].

mod choices;
mod pairs;
mod scene;
mod subject;

pub use choices::{choices, speed_options, takes};
pub use pairs::{Pair, Pairs, pairwise};
pub use scene::{EYE, assert_same, general_rays, ray_count, rays, scene};
pub use subject::{Answers, Row, Subject, first_difference};

//! Conformance of structures: every row (a structure in a configuration) against every hard case.
//!
//! A row says what is demanded of it: an exact answer, or a bound of its error rate. Where a row cannot
//! meet its demand on a case, it carries a [`Deviation`] with the reason and the range that its error
//! rate must lie in, so that an unexpected pass fails as well.

mod deviations;
mod judge;
mod measure;
mod prepare;
mod rounds;
mod rows;

pub use judge::judge;
pub use measure::{Measured, device_hit, measure};
pub use prepare::{Prepared, loadable};
pub use rounds::trace_in_rounds;
pub use rows::{Cases, DEEP, Demand, Deviation, Law, ROWS, Row};

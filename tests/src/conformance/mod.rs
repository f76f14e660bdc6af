//! Conformance of structures: every row (a system with a preset and options) against every hard case.
//!
//! A row says what is demanded of it: an exact answer, or a bound of its error rate. Where a row cannot
//! meet its demand on a case, it carries a [`Deviation`] with the reason and the range that its error
//! rate must lie in, so that an unexpected pass fails as well. Rows that find triangles without loss may
//! carry none.
//!
//! Another structure needs one row in a file of its own, listed in [`ROWS`], once its system is in the
//! registry: a name, the system, the preset, options, and [`Demand::Exact`], [`Demand::Law`] or
//! [`Demand::Loss`]. The tests hold every row without being told; one of them fails for a preset of the
//! registry that no row stands for. A list of deviations starts empty: the first run reports every case whose
//! rate is beyond the law, with the rate. `RASRAY_RATES=1` with `--nocapture` prints all rates.
//!
//! Rates are evaluated by their interval, so that all evaluations together are wrong with a probability of at
//! most [`FALSE_ALARM`] where every law holds, whatever the seed.

mod deviations;
mod deviations_ambiguous;
mod deviations_dirt;
mod deviations_ldc;
mod deviations_voxel;
mod evaluate;
mod measure;
mod prepare;
mod rounds;
mod row;
mod rows;
mod rows_bricks;
mod rows_bvh;
mod rows_dirt;
mod rows_ldc;
mod rows_mmrt;
mod rows_voxel;

pub use evaluate::{FALSE_ALARM, confidence, evaluate};
pub use measure::{answers, compare, first_other, measure, try_answers};
pub use prepare::Prepared;
pub use rasray_experiment::Measured;
pub use rounds::trace_in_rounds;
pub use row::{Cases, Curve, DEEP, Demand, Deviation, Law, Row, Tier};
pub use rows::{LARGE, ROWS, SHARE, comparisons, is_held};

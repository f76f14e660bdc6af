//! Plans of many comparisons of systems, and tables of their results, as data. The commands `rasray ablate`
//! and `rasray replicate` use this crate to read plans and to write pages.
//!
//! - [`Plan`] is a plan from a `.toml` file: lists of values for options, of which every combination is
//!   compared.
//! - [`PAPERS`] has a plan for each table and figure of the papers ([`Paper`], [`Item`]), with the published
//!   numbers.
//! - [`Claim`] compares a result with a published number; [`paper_page`], [`csv_table`] and [`Sheet`] are the
//!   tables.
//! - [`estimate()`] predicts the time of a plan from runs that were made.
//!
//! The crate needs no Vulkan and no command line: the comparisons of a plan are words as `rasray compare`
//! takes them.

mod brief;
mod claim;
mod estimate;
mod page;
mod paper;
mod plan;
mod sheet;
mod table;

pub use claim::{Claim, Finding};
pub use estimate::{Estimate, estimate};
pub use page::paper_page;
pub use paper::{Item, PAPERS, Paper, word};
pub use plan::{ComparisonPlan, Exclusion, ExperimentPlan, Plan, PlanError};
pub use sheet::{SHEET_COLUMNS, Sheet};
pub use table::csv_table;

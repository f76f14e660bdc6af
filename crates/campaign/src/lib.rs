//! Plans of many comparisons of systems, and the tables of their results, as data. The commands `rasray
//! ablate` and `rasray replicate` read plans with it and write its pages.
//!
//! - [`Plan`] is a plan of a `.toml` file: lists of options, of which every combination is compared.
//! - [`PAPERS`] has a plan for each table and figure of the papers ([`Paper`], [`Item`]), with the published
//!   numbers.
//! - [`Claim`] holds a result against a published number; [`paper_page`], [`csv_table`] and [`Sheet`] are the
//!   tables.
//! - [`estimate()`] predicts how long a plan takes from runs that were made.
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

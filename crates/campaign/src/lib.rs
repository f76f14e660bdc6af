//! Plans of many comparisons as data: lists of options, of which every combination is compared; tables of what came of
//! them; and plans of the papers' tables and figures, with what was published. No Vulkan, no command line: a plan's
//! comparisons are words as `rasray compare` takes them.

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

//! Every test of this package as one program, which is built and linked once: a module for each concern,
//! whose first lines say what it holds. `tools/run-tests` runs each module in a process of its own.

mod disagreement;
#[path = "embed.rs"]
mod embedded;
mod law;
mod lit;
mod points;
mod upkeep;

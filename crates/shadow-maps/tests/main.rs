//! All tests of this package in one program, which is built and linked once. Each concern has a module, whose
//! first lines say what it tests. `tools/run-tests` runs each module in a process of its own.

mod disagreement;
#[path = "embed.rs"]
mod embedded;
mod law;
mod lit;
mod points;
mod upkeep;

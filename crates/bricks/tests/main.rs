//! Every test of this package as one program, which is built and linked once: a module for each concern,
//! whose first lines say what it holds. `tools/run-tests` runs each module in a process of its own.

#![allow(clippy::duplicate_mod, reason = "each of two examples brings the host that they share")]

#[path = "embed.rs"]
mod embedded;
#[path = "inline.rs"]
mod inlined;

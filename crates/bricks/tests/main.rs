//! All tests of this package in one program, which is built and linked once. Each concern has a module, whose
//! first lines say what it tests. `tools/run-tests` runs each module in a process of its own.

#![allow(clippy::duplicate_mod, reason = "each of two examples brings the host that they share")]

#[path = "embed.rs"]
mod embedded;
#[path = "inline.rs"]
mod inlined;

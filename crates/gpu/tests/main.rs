//! All tests of this package in one program, which is built and linked once: one module per concern, whose
//! first lines describe it. `tools/run-tests` runs each module in a process of its own.

#[path = "device/main.rs"]
mod device;
mod installation;

//! Counts of the recorded commands, pass by pass.

use crate::stage::Stage;

/// Counts of the commands of one pass: the amount of work that a device is given, without running it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PassCommands {
    /// Part of a frame that the pass belongs to.
    pub stage: Stage,
    /// Label of the pass.
    pub label: String,
    /// Number of dispatches with workgroups that the host knows.
    pub dispatches: u32,
    /// Number of workgroups of all these dispatches.
    pub workgroups: u64,
    /// Number of dispatches and draws whose size the device reads from a buffer.
    pub indirect: u32,
    /// Number of draws with vertices that the host knows.
    pub draws: u32,
    /// Number of vertices of all these draws, once per instance.
    pub vertices: u64,
    /// Number of fills, updates and copies of buffers.
    pub transfers: u32,
    /// Number of trees that the driver builds.
    pub trees: u32,
}

impl PassCommands {
    /// Makes the counts of a pass without commands.
    pub fn of(stage: Stage, label: &str) -> Self {
        Self {
            stage,
            label: label.to_owned(),
            dispatches: 0,
            workgroups: 0,
            indirect: 0,
            draws: 0,
            vertices: 0,
            transfers: 0,
            trees: 0,
        }
    }
}

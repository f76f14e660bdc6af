//! Commands recorded, pass by pass.

use crate::stage::Stage;

/// The commands of one pass: how much a device is told to do, without running it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PassCommands {
    /// Part of a frame that the pass belongs to.
    pub stage: Stage,
    /// Label of the pass.
    pub label: String,
    /// Dispatches whose workgroups the host knows.
    pub dispatches: u32,
    /// Workgroups of them all.
    pub workgroups: u64,
    /// Dispatches and draws whose size the device reads from a buffer.
    pub indirect: u32,
    /// Draws whose vertices the host knows.
    pub draws: u32,
    /// Vertices of them all, once per instance.
    pub vertices: u64,
    /// Fills, updates and copies of buffers.
    pub transfers: u32,
    /// Trees that the driver builds.
    pub trees: u32,
}

impl PassCommands {
    /// A pass without commands.
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

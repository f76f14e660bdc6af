//! What was recorded, pass by pass.

/// The commands of one pass: how much a device is told to do, without running it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PassCommands {
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
}

impl PassCommands {
    pub(super) fn of(label: &str) -> Self {
        Self { label: label.to_owned(), ..Self::default() }
    }
}

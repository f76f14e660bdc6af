//! Pools of the grid.

use crate::{Config, Contents, Header};

rasray_ads::pools! {
    /// Pools of a grid, in the order of their bindings.
    pub enum Pool: Header {
        /// End of the list of each cell.
        Lists "lists" lists_address => lists,
        /// Triangles of all lists.
        Entries "entries" entries_address => entries,
        /// Sums of the scan, and the large-triangle queue.
        Scratch "scratch" scratch_address,
    }
    Config => Contents { header }
}

//! Pools of primitive lists.

use crate::{Config, Contents, Header};

rasray_ads::pools! {
    /// Pools of primitive lists, in the order of their bindings.
    pub enum Pool: Header {
        /// Depth bounds of tiles and of blocks of tiles.
        Bounds "bounds" bounds_address => bounds,
        /// Heads or ends of lists.
        Lists "lists" lists_address => lists,
        /// Triangle ids of all lists.
        Entries "entries" entries_address => entries,
        /// Sums of the scan.
        Sums "sums" sums_address,
        /// Triangles in the near region.
        Near "near" near_address => near,
        /// The large-triangle queue.
        Large "large" large_address,
    }
    Config => Contents { header, config }
}

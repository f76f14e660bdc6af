//! The pools.

use crate::{Config, Contents, Header};

rasray_ads::pools! {
    /// Pools of bricks, in the order of their bindings.
    pub enum Pool: Header {
        /// Words and masks of bricks.
        Bricks "bricks" bricks_address => bricks,
        /// End of the list of each cell that has one.
        Lists "lists" lists_address => lists,
        /// Triangles of all lists.
        Entries "entries" entries_address => entries,
        /// Sums of scans, later distances.
        Sums "sums" sums_address,
        /// Triangles in the near region.
        Near "near" near_address => near,
        /// Records: triangles in columns.
        Records "records" records_address,
        /// Corners of triangles; during the build the large-triangle queue.
        Triangles "triangles" triangles_address,
    }
    Config => Contents { header, config }
}

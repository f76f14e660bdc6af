//! Pools of the bricks.

use crate::{Config, Contents, Header};

rasray_ads::pools! {
    /// Pools of bricks, in the order of their bindings.
    pub enum Pool: Header {
        /// Words and masks of bricks.
        Bricks "bricks" bricks_address => bricks,
        /// End of the list of each cell that has a list.
        Lists "lists" lists_address => lists,
        /// Triangles of all lists.
        Entries "entries" entries_address => entries,
        /// Sums of scans during the build, and distances of bricks afterwards.
        Sums "sums" sums_address,
        /// Triangles in the near region.
        Near "near" near_address => near,
        /// Records: triangles in columns of cells.
        Records "records" records_address,
        /// Corners of triangles; during the build, the large-triangle queue.
        Triangles "triangles" triangles_address,
    }
    Config => Contents { header, config }
}

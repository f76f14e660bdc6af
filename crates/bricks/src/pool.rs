//! The pools.

rasray_ads::pool_names! {
    /// Pools of bricks, in the order of their bindings.
    pub enum Pool {
        /// What shaders start from.
        Header = "header",
        /// Words and masks of bricks.
        Bricks = "bricks",
        /// Where the list of each cell that has one ends.
        Lists = "lists",
        /// Triangles of all lists.
        Entries = "entries",
        /// Sums of scans, later distances.
        Sums = "sums",
        /// Triangles in the near region.
        Near = "near",
        /// Records: triangles in columns.
        Records = "records",
        /// Corners of triangles; during the build the large-triangle queue.
        Triangles = "triangles",
    }
}

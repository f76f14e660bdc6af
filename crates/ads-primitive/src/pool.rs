//! The pools.

rasray_ads::pool_names! {
    /// Pools of primitive lists, in the order of their bindings.
    pub enum Pool {
        /// What shaders start from.
        Header = "header",
        /// Depths of tiles, and of blocks of them.
        Bounds = "bounds",
        /// Heads or ends of lists.
        Lists = "lists",
        /// Triangles of all lists.
        Entries = "entries",
        /// Sums of the scan.
        Sums = "sums",
        /// Triangles in the near region.
        Near = "near",
        /// The large-triangle queue.
        Large = "large",
    }
}

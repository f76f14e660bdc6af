//! The pools.

rasray_ads::pool_names! {
    /// Pools of a grid, in the order of their bindings.
    pub enum Pool {
        /// What shaders start from.
        Header = "header",
        /// Where the list of each cell ends.
        Lists = "lists",
        /// Triangles of all lists.
        Entries = "entries",
        /// Sums of the scan, and the large-triangle queue.
        Scratch = "scratch",
    }
}

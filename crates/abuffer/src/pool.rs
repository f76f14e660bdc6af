//! The pools.

rasray_ads::pool_names! {
    /// Pools of an A-buffer, in the order of their bindings.
    pub enum Pool {
        /// What shaders start from.
        Header = "header",
        /// Depths of cells and blocks, and marks of triangles.
        Bounds = "bounds",
        /// Heads or ends of lists.
        Lists = "lists",
        /// Fragments, or pages of them.
        Nodes = "nodes",
        /// What fragments carry, where that is not in the nodes.
        Data = "data",
        /// Triangles in the near region.
        Near = "near",
        /// Sums of the scan, and what a build remembers.
        Scratch = "scratch",
        /// Triangles that no fragment stands for.
        Conservative = "conservative",
    }
}

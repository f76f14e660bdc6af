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
        /// Nodes of fragments, or of pages of them.
        Nodes = "nodes",
        /// Payload of fragments, where it is not in the nodes.
        Data = "data",
        /// Triangles in the near region.
        Near = "near",
        /// Sums of the scan, long lists, and the large-triangle queue.
        Scratch = "scratch",
        /// Nodes of the conservative lists.
        Conservative = "conservative",
    }
}

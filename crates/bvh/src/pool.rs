//! The pools.

rasray_ads::pool_names! {
    /// Pools of a tree, in the order of their bindings.
    pub enum Pool {
        /// What shaders start from.
        Header = "header",
        /// Inner nodes.
        Nodes = "nodes",
        /// Corners of triangles, in the order of leaves.
        Records = "records",
        /// What only the build uses.
        Scratch = "scratch",
    }
}

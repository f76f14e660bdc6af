//! The pools.

rasray_ads::pool_names! {
    /// Pools of a layered depth cube, in the order of their bindings.
    pub enum Pool {
        /// What shaders start from.
        Header = "header",
        /// Where the fragments of each cell end.
        Lists = "lists",
        /// Depths of fragments.
        Depths = "depths",
        /// Payload of fragments, in addition to their depth.
        Payload = "payload",
        /// Depths of blocks of cells.
        Blocks = "blocks",
        /// Heads of the conservative lists.
        Heads = "heads",
        /// Nodes of the conservative lists.
        Conservative = "conservative",
        /// Sums of the scan, long lists or counts of layers, and the large-triangle queue.
        Scratch = "scratch",
    }
}

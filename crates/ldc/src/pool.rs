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
        /// What fragments carry in addition to their depth.
        Payload = "payload",
        /// What blocks of cells hold.
        Blocks = "blocks",
        /// Heads of the lists of triangles that no fragment stands for.
        Heads = "heads",
        /// Those triangles.
        Conservative = "conservative",
        /// Sums of the scan, and what a build remembers.
        Scratch = "scratch",
    }
}

//! The pools.

rasray_ads::pool_names! {
    /// Pools of voxels, in the order of their bindings.
    pub enum Pool {
        /// What shaders start from.
        Header = "header",
        /// Axes of voxels.
        Voxels = "voxels",
        /// Sums of normals.
        Normals = "normals",
        /// Heads or ends of lists; where voxels are the leaves, the triangles of voxels.
        Lists = "lists",
        /// Fragments, or pages of them.
        Fragments = "fragments",
        /// Sums of the scan, long lists, and the large-triangle queue.
        Scratch = "scratch",
        /// Nodes of the octree.
        Nodes = "nodes",
        /// What the octree's build counts, with sums of its scan.
        Octants = "octants",
    }
}

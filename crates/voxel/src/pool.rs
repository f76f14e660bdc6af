//! The pools.

use crate::{Config, Contents, Header};

rasray_ads::pools! {
    /// Pools of voxels, in the order of their bindings.
    pub enum Pool: Header {
        /// Axes of voxels.
        Voxels "voxels" voxels_address => voxels,
        /// Sums of normals.
        Normals "normals" normals_address,
        /// Heads or ends of lists; where voxels are the leaves, the triangles of voxels.
        Lists "lists" lists_address => lists,
        /// Fragments, or pages of them.
        Fragments "fragments" fragments_address => fragments,
        /// Sums of the scan, long lists, and the large-triangle queue.
        Scratch "scratch" scratch_address,
        /// Nodes of the octree.
        Nodes "nodes" nodes_address => nodes,
        /// Counts of the octree's build, with sums of its scan.
        Octants "octants" octants_address,
    }
    Config => Contents { header, config }
}

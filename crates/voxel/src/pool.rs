//! Pools of the voxels.

use crate::{Config, Contents, Header};

rasray_ads::pools! {
    /// Pools of voxels, in the order of their bindings.
    pub enum Pool: Header {
        /// Bits of voxels: search axes and occupancy.
        Voxels "voxels" voxels_address => voxels,
        /// Sums of the normals of voxels.
        Normals "normals" normals_address,
        /// Heads or ends of lists; if voxels are the leaves, the triangles of voxels.
        Lists "lists" lists_address => lists,
        /// Fragments, or pages of fragments.
        Fragments "fragments" fragments_address => fragments,
        /// Sums of the scan, long lists, and the large-triangle queue.
        Scratch "scratch" scratch_address,
        /// Nodes of the octree.
        Nodes "nodes" nodes_address => nodes,
        /// Counts of the octree's build, and the sums of its scan.
        Octants "octants" octants_address,
    }
    Config => Contents { header, config }
}

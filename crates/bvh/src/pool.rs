//! Pools of the BVH.

use crate::Header;

rasray_ads::pools! {
    /// Pools of a tree, in the order of their bindings.
    pub enum Pool: Header {
        /// Inner nodes.
        Nodes "nodes" nodes_address,
        /// Records: corners of triangles, in the order of leaves.
        Records "records" records_address,
        /// Words that only the build uses.
        Scratch "scratch" scratch_address,
    }
}

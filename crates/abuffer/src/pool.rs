//! Pools of the A-buffer.

use crate::{Config, Contents, Header};

rasray_ads::pools! {
    /// Pools of an A-buffer, in the order of their bindings.
    pub enum Pool: Header {
        /// Depth bounds of cells and blocks, and marks of triangles.
        Bounds "bounds" bounds_address => bounds,
        /// Heads or ends of lists.
        Lists "lists" lists_address => lists,
        /// Nodes, each with a fragment or a page of fragments.
        Nodes "nodes" nodes_address => nodes,
        /// Payload of fragments, if it is not in the nodes.
        Data "data" data_address => data,
        /// Triangles in the near region.
        Near "near" near_address => near,
        /// Sums of the scan, long lists, and the large-triangle queue.
        Scratch "scratch" scratch_address => scratch,
        /// Nodes of the conservative lists.
        Conservative "conservative" conservative_address => conservative,
    }
    Config => Contents { header, config }
}

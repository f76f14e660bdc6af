//! Pools of the layered depth cube.

use crate::{Config, Contents, Header};

rasray_ads::pools! {
    /// Pools of a layered depth cube, in the order of their bindings.
    pub enum Pool: Header {
        /// End of the fragments of each cell.
        Lists "lists" lists_address => lists,
        /// Depths of fragments.
        Depths "depths" depths_address => depths,
        /// Payload of fragments: all that they carry in addition to their depth.
        Payload "payload" payload_address => payload,
        /// Depth bounds of blocks of cells, and their slices.
        Blocks "blocks" blocks_address => blocks,
        /// Heads of the conservative lists.
        Heads "heads" heads_address => heads,
        /// Nodes of the conservative lists.
        Conservative "conservative" conservative_address => conservative,
        /// Sums of the scan; long lists or counts of layers; and the large-triangle queue.
        Scratch "scratch" scratch_address,
    }
    Config => Contents { header, config }
}

//! Pools of the driver's tree.

use crate::{Config, Contents, Header};

rasray_ads::pools! {
    /// Pools of the driver's tree, in the order of their bindings.
    pub enum Pool: Header {
        /// Boxes over which the driver builds the tree.
        Boxes "boxes" boxes_address => boxes,
    }
    Config => Contents { header }
}

//! The pools.

use crate::{Config, Contents, Header};

rasray_ads::pools! {
    /// Pools of the driver's tree, in the order of their bindings.
    pub enum Pool: Header {
        /// The boxes over which it is built.
        Boxes "boxes" boxes_address => boxes,
    }
    Config => Contents { header }
}

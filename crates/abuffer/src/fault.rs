//! Faults that the check of a built A-buffer may find.

/// Fault of a list.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// A link points to no node.
    #[error("cell {cell}, bucket {bucket}: link {link} points to no node")]
    Dangling {
        /// Cell.
        cell: usize,
        /// Bucket.
        bucket: usize,
        /// The link.
        link: u32,
    },
    /// A link of a conservative list points to no node, or leads in a circle.
    #[error("cell {cell}: link {link} of the conservative list points to no node, or leads in a circle")]
    Conservative {
        /// Cell.
        cell: usize,
        /// The link.
        link: u32,
    },
    /// A node is in no list, or in more than one.
    #[error("{stored} nodes were allocated and {linked} are in lists")]
    Count {
        /// Nodes allocated.
        stored: usize,
        /// Nodes found in lists.
        linked: usize,
    },
    /// Forward and backward links disagree.
    #[error("cell {cell}, bucket {bucket}: the backward link of node {link} is {prev}, expected {expected}")]
    Backward {
        /// Cell.
        cell: usize,
        /// Bucket.
        bucket: usize,
        /// The node's link.
        link: u32,
        /// Backward link stored.
        prev: u32,
        /// Backward link expected.
        expected: u32,
    },
    /// A contiguous list does not begin where the one before it ends.
    #[error("cell {cell}: the list begins at place {first}, expected {expected}")]
    Place {
        /// Cell.
        cell: usize,
        /// Beginning stored.
        first: u32,
        /// Beginning expected.
        expected: usize,
    },
    /// A page is in two lists, or has more or fewer used slots than the word that leads to it says.
    #[error(
        "cell {cell}, bucket {bucket}: page {page} is in two lists, or its used slots are not those counted"
    )]
    Page {
        /// Cell.
        cell: usize,
        /// Bucket.
        bucket: usize,
        /// Number of the page.
        page: usize,
    },
    /// A contiguous node refers to a payload that does not exist or is another's.
    #[error("cell {cell}: node {link} refers to the payload {place}, which does not exist or is another's")]
    Payload {
        /// Cell.
        cell: usize,
        /// The node's link.
        link: u32,
        /// Payload stored.
        place: u32,
    },
    /// The tail is not the last node.
    #[error("cell {cell}, bucket {bucket}: the tail is {tail}, the last node is {last}")]
    Tail {
        /// Cell.
        cell: usize,
        /// Bucket.
        bucket: usize,
        /// Tail stored.
        tail: u32,
        /// The last node's link.
        last: u32,
    },
    /// A sorted list is not in order.
    #[error("cell {cell}, bucket {bucket}: node {link} is out of order")]
    Order {
        /// Cell.
        cell: usize,
        /// Bucket.
        bucket: usize,
        /// The node's link.
        link: u32,
    },
    /// A depth lies outside of the cell's bounds or is not a positive number.
    #[error("cell {cell}, bucket {bucket}: depth {z} of node {link} is outside of [{z_min}, {z_max}]")]
    Depth {
        /// Cell.
        cell: usize,
        /// Bucket.
        bucket: usize,
        /// The node's link.
        link: u32,
        /// The depth, as text: it may be NaN.
        z: String,
        /// Smallest depth of the cell.
        z_min: String,
        /// Largest depth of the cell.
        z_max: String,
    },
}
